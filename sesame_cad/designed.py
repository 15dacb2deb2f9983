"""A design as values, for Python programs and notebooks."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from patterns.records import plan_records
from sesame_cad.design_data import design_data
from sesame_cad.designed_sleeves import DesignedSleeves
from sesame_cad.notebook import notebook_html
from sesame_cad.package import pictures, write_design
from sesame_cad.pipeline import Design, Pattern
from sesame_cad.pipeline import design as made_from
from sesame_cad.shape_state import ShapeState
from sesame_cad.sleeve.design import sleeve_design
from sesame_cad.specification import Specification, load_specification, specification_from
from sesame_cad.specification.layout import SLEEVE

Progress = Callable[[str], None]
Data = dict[str, Any]


def design(
    spec: str | Path | Mapping[str, Any],
    overrides: Mapping[str, Any] | None = None,
    *,
    progress: Progress = lambda _: None,
) -> Designed | DesignedSleeves:
    """Design an array, or beams with sleeves (``layout.kind = "sleeve"``).

    Parameters
    ----------
    spec : path or mapping
        A specification file, or what such a file holds: ``{"wire": {...}, "layout": {...}}``.
    overrides : mapping, optional
        Values that replace others, by their full keys, such as ``{"layout.rows": 2}``.
    progress : callable
        Told what is being done.

    Raises
    ------
    InputError
        When the specification asks for what cannot be made; ``faults`` holds a line each.
    NotConvergedError
        When there is no shape to rely on.
    """
    changed = dict(overrides or {})
    if isinstance(spec, Mapping):
        name = str(spec.get("name", "array"))
        specification = specification_from(dict(spec), name, "specification", changed)
    else:
        specification = load_specification(Path(spec), changed)
    if specification.layout.kind == SLEEVE:
        return DesignedSleeves(sleeve_design(specification, progress))
    return Designed(made_from(specification, progress))


@dataclass(frozen=True)
class Designed:
    """A design that was made; nothing is written until `write`.

    Attributes
    ----------
    made : Design
        All of it.
    """

    made: Design

    @property
    def spec(self) -> Specification:
        """The specification, checked, with every default filled in."""
        return self.made.spec

    @property
    def pattern(self) -> Pattern:
        """Circuit, outline, registration marks, stitches and electrical net."""
        return self.made.pattern

    @property
    def cold(self) -> ShapeState | None:
        """Shape below the wire's transition; None when no shape is predicted."""
        return self._state("cold")

    @property
    def hot(self) -> ShapeState | None:
        """Shape above it."""
        return self._state("hot")

    @cached_property
    def data(self) -> Data:
        """What `design.json` says, but for the list of files."""
        records = plan_records(self.pattern.plan, self.spec.patterns_machine())
        return design_data(self.made, records, {})

    def write(self, folder: str | Path, progress: Progress = lambda _: None) -> Data:
        """Write the fabrication package, and give what its `design.json` holds.

        Raises
        ------
        InputError
            When the folder cannot be made, or holds something else.
        """
        return write_design(self.made, Path(folder), progress)

    def _state(self, name: str) -> ShapeState | None:
        return next((state for state in self.made.states if state.name == name), None)

    def _repr_html_(self) -> str:
        """Show the numbers and a picture where notebooks display a value."""
        return notebook_html(self.spec.name, self._rows, pictures(self.made))

    @property
    def _rows(self) -> list[tuple[str, str]]:
        rows = [
            (f"{state.name} shape", f"{state.height_mm:.2f} mm high" if state.buckled else "flat")
            for state in self.made.states
        ]
        circuit, stitch = self.data["circuit"], self.data["stitch"]
        return [
            *rows,
            ("wire", f"{circuit['wire_length_mm']:.0f} mm with tails"),
            ("resistance, cold", f"{circuit['resistance_ohm_cold']:.2f} Ω"),
            ("stitches", f"{stitch['stitches']}"),
        ]
