"""A predicted shape of an array, however it was solved."""

from __future__ import annotations

from sesame_cad.coupled_state import CoupledState
from sesame_cad.state import CellState

ShapeState = CellState | CoupledState
"""One cell's shape side by side, or all loops solved together: both tell the same of themselves."""
