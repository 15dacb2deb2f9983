"""What some machines want of DST files."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class DstSwitches:
    """What some machines want of a file beyond the format.

    Attributes
    ----------
    refuses_zero_colours : bool
        The header's CO is at least 1.
    double_stop : bool
        Every stop stands there twice, which forces some machines to stop (Tajima).
    """

    refuses_zero_colours: bool = False
    double_stop: bool = False
