"""A predicted shape of an array, however it was solved."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from sesame_cad.state import CellState

if TYPE_CHECKING:  # only designs of coupled loops load their solver
    from sesame_cad.coupled_state import CoupledState

ShapeState: TypeAlias = "CellState | CoupledState"
"""One cell's shape side by side, or all loops solved together: both tell the same of themselves."""
