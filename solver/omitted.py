"""What a solve left out, with the number that says how much that matters."""

from __future__ import annotations

from dataclasses import dataclass

SMALL = 0.01
"""A neglected term below a hundredth of what is kept is not worth a warning."""


@dataclass(frozen=True, slots=True)
class OmittedTerm:
    """A part of the physics that is not in the energy.

    Attributes
    ----------
    term : str
        Its name.
    measure : str
        What the number is.
    value : float
        How large it is; the smaller, the better the omission.
    matters : bool
        Whether the user should be warned of it.
    fatal : bool
        Whether the shape is wrong without it.
    """

    term: str
    measure: str
    value: float
    matters: bool
    fatal: bool = False
