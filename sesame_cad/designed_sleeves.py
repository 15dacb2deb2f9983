"""A design of beams with sleeves as values, for Python programs and notebooks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from sesame_cad.notebook import notebook_html
from sesame_cad.package import pictures, write_design
from sesame_cad.sleeve.data import sleeve_design_data
from sesame_cad.sleeve.design import SleeveDesign
from sesame_cad.sleeve.hold import Hold
from sesame_cad.sleeve.pattern import SleevePattern
from sesame_cad.sleeve.summary import sleeve_rows
from sesame_cad.specification import Specification
from solver.sleeve.segment import SegmentPrediction

Data = dict[str, Any]


@dataclass(frozen=True)
class DesignedSleeves:
    """Beams with sleeves that were designed; nothing is written until `write`.

    Attributes
    ----------
    made : SleeveDesign
        All of it.
    """

    made: SleeveDesign

    @property
    def spec(self) -> Specification:
        """The specification, checked, with every default filled in."""
        return self.made.spec

    @property
    def pattern(self) -> SleevePattern:
        """Both arrays as they lie on each other, and what is cut from plastic."""
        return self.made.pattern

    @property
    def prediction(self) -> SegmentPrediction | None:
        """What a beam with its sleeves does, in SI units; None when nothing is predicted."""
        return self.made.prediction

    @property
    def hold(self) -> Hold | None:
        """Where the ties of the compressed sleeve lie, and the hooks that hold them."""
        return self.made.hold

    @cached_property
    def data(self) -> Data:
        """What `design.json` says, but for the list of files."""
        return sleeve_design_data(self.made, {})

    def write(self, folder: str | Path, progress: Callable[[str], None] = lambda _: None) -> Data:
        """Write the fabrication package, and give what its `design.json` holds.

        Raises
        ------
        InputError
            When the folder cannot be made, or holds something else.
        """
        return write_design(self.made, Path(folder), progress)

    def _repr_html_(self) -> str:
        """Show the numbers and pictures where notebooks display a value."""
        return notebook_html(self.spec.name, sleeve_rows(self.data), pictures(self.made))
