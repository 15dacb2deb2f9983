"""What is found at one point of a sweep, and how it stands in a table."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

CONVERGED = "converged"


@dataclass(frozen=True, slots=True)
class Outcome:
    """One point's shape. Numbers are None where there is none to give.

    Attributes
    ----------
    strain, beta, poisson : float or None
        The loop, or the unit of a coupled array.
    height_over_perimeter : float or None
        Of an array solved on a mesh, that of the whole over one loop's perimeter.
    pitch_over_diameter : float or None
    energy : float or None
        In units of E_f t R²; of an array, of all loops together.
    smallest_stress : float or None
        Smallest principal stress of the fabric over E_f, where it is known.
    height_mm, pitch_mm, energy_mJ : float or None
        The same where the point is a specification; energy of one loop.
    buckled, slack, self_meeting : bool or None
        ``slack``: fabric in compression, which would wrinkle; ``self_meeting``: the wire touches
        or passes through itself. Either makes the shape unphysical.
    status : str
        ``"converged"``, or why the numbers must not be relied on.
    """

    strain: float | None
    beta: float | None
    poisson: float | None
    height_over_perimeter: float | None = None
    pitch_over_diameter: float | None = None
    energy: float | None = None
    smallest_stress: float | None = None
    height_mm: float | None = None
    pitch_mm: float | None = None
    energy_mJ: float | None = None  # noqa: N815 - the unit's own spelling
    buckled: bool | None = None
    slack: bool | None = None
    self_meeting: bool | None = None
    status: str = CONVERGED

    @property
    def physical(self) -> bool:
        """Whether the numbers are those of a loop that can exist."""
        return self.status == CONVERGED and not self.slack and not self.self_meeting


COLUMNS: tuple[str, ...] = tuple(field.name for field in fields(Outcome))
_FLAGS = {"buckled", "slack", "self_meeting"}
_WORDS = {True: "yes", False: "no", None: ""}


def cells(outcome: Outcome) -> list[str]:
    """Write an outcome as cells of a table; floats to the last bit."""
    values: list[Any] = [getattr(outcome, name) for name in COLUMNS]
    return [
        _WORDS[value] if name in _FLAGS else "" if value is None else str(value)
        for name, value in zip(COLUMNS, values, strict=True)
    ]


def outcome_of(row: list[str]) -> Outcome:
    """Read cells back.

    Raises
    ------
    ValueError
        When they are not those of an outcome.
    """
    if len(row) != len(COLUMNS):
        raise ValueError(f"{len(row)} cells instead of {len(COLUMNS)}")
    flags = {word: value for value, word in _WORDS.items()}
    given: dict[str, Any] = {}
    for name, cell in zip(COLUMNS, row, strict=True):
        if name == "status":
            given[name] = cell
        elif name in _FLAGS:
            if cell not in flags:
                raise ValueError(f"{name} = {cell!r}")
            given[name] = flags[cell]
        else:
            given[name] = float(cell) if cell else None
    return Outcome(**given)
