"""The coupon as it is sewn, with what each cell holds."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from patterns.coupon import Cell, Coupon
from patterns.plan import UNITS_PER_MM, BlockKind
from sesame_cad.drawing_colours import COVER, MARK, STAGES
from sesame_cad.pictures.canvas import png_bytes
from sesame_cad.pictures.plan import NEEDLE

OUTSIDE = "#C00000"
HEADS = {
    "width": "W: couching width, mm",
    "interval": "I: interval, mm",
    "cover": "C: cover width, mm",
}


def coupon_picture(made: Coupon, wire_diameter_mm: float, needle_diameter_mm: float) -> bytes:
    """Draw wire, thread and labels; a PNG whose bytes can be made again.

    Below the drawing stands what each number means; what is outside of the usual limits is red.
    """
    figure = Figure(figsize=(9.0, 7.0), layout="constrained")
    axes, table = figure.subplots(2, 1, height_ratios=(4, 1))
    _draw_thread(axes, made)
    for stage, colour in zip(made.circuit.stages, STAGES, strict=False):
        axes.plot(*stage.polyline(0.02).T, color=colour, linewidth=1.6, zorder=3)
    axes.set_aspect("equal")
    axes.margins(0.03)
    axes.set_xlabel("x, mm, on the stretched fabric")
    axes.set_ylabel("y, mm")
    axes.spines[["top", "right"]].set_visible(False)
    _write_table(table, made.cells, wire_diameter_mm + needle_diameter_mm)
    return png_bytes(figure)


def _draw_thread(axes: Axes, made: Coupon) -> None:
    colours = {BlockKind.MARKS: MARK, BlockKind.WIRE: NEEDLE, BlockKind.COVER: COVER}
    for block in made.plan.blocks:
        runs = [run.needles / UNITS_PER_MM for run in block.runs]
        width = 0.5 if block.kind.is_wire else 0.9
        axes.add_collection(
            LineCollection(runs, colors=colours[block.kind], linewidths=width, zorder=4)
        )
        if block.kind.is_wire:
            axes.scatter(*runs[0].T, s=2.0, c=NEEDLE, linewidths=0, zorder=5)


def _write_table(axes: Axes, cells: tuple[Cell, ...], least_mm: float) -> None:
    """Write the values, a line a row of cells."""
    axes.set_axis_off()
    axes.set_xlim(0, 10)
    axes.set_ylim(-4.2, 0.5)
    rows = list(dict.fromkeys(cell.row for cell in cells))
    for k, row in enumerate(rows):
        axes.text(0, -k - 1, HEADS[row], va="center")
    for cell in cells:
        place = 3.6 + 1.1 * (cell.number - 1), -rows.index(cell.row) - 1
        value = cell.interval_mm if cell.row == "interval" else least_mm + 2 * cell.margin_mm
        colour = MARK if cell.usual else OUTSIDE
        axes.text(*place, f"{value:.2f}", va="center", ha="center", color=colour)
        axes.text(place[0], 0, str(cell.number), va="center", ha="center", weight="bold")
    axes.text(0, -4, "red: outside of what the settings advise; sewn all the same", color=OUTSIDE)
