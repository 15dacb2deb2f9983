"""What this package raises."""

from __future__ import annotations


class InputError(Exception):
    """What was asked for cannot be done as given; each fault is one line.

    Attributes
    ----------
    faults : tuple of str
        One line each, in words for whoever gave the input.
    """

    def __init__(self, *faults: str) -> None:
        super().__init__(*faults)
        self.faults: tuple[str, ...] = faults

    def __str__(self) -> str:
        return "\n".join(self.faults)


class DesignFileError(ValueError):
    """A design file that cannot be read; the message says, in one line, where and why."""
