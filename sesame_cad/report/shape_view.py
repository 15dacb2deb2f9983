"""What the page shows in space of any design."""

from __future__ import annotations

from typing import Any

from sesame_cad.coupled_state import CoupledState
from sesame_cad.pipeline import Design
from sesame_cad.report.cell_view import cell_view
from sesame_cad.report.sheet_view import sheet_view
from sesame_cad.state import CellState


def shape_view(design: Design) -> dict[str, Any] | None:
    """Data of the 3-D view; none of a design without a shape."""
    match design.states:
        case (CellState() as cold, CellState() as hot):
            return cell_view(design.spec, cold, hot)
        case (CoupledState() as cold, CoupledState() as hot):
            return sheet_view(design.spec, cold, hot)
        case _:
            return None
