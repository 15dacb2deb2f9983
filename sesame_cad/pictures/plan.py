"""The wire's way through the array, as the operator sees it."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from numpy.typing import NDArray

from patterns.circuit import Circuit
from patterns.loop_order import loops_in_order
from patterns.outline import Outline
from patterns.path import WirePath
from patterns.plan import UNITS_PER_MM, BlockKind, StitchPlan
from patterns.registration import Mark
from sesame_cad.drawing_colours import COVER, MARK, STRIPE, TIE, stage_colour
from sesame_cad.pictures.canvas import png_bytes

Vectors = NDArray[np.float64]

NEEDLE, CUT = "#777777", "#555555"

_WIDTH_IN = 9.0
_NEEDLE_PT = 1.7
_PIXEL_SHARE = 1 / 2700
"""Half a pixel as a share of the width: nothing smaller is seen."""

_MOST_NUMBERS = 400
"""The numbers of more loops than this cannot be read."""

_GROUND = {"facecolor": "white", "edgecolor": "none", "pad": 0.5, "alpha": 0.8}
"""Below words and numbers, that lines do not strike through."""

_ARROW_SHARE, _LARGEST_ARROW = 0.02, 0.25
"""Length of arrow heads as a share of the width, but at most this share of the smallest loop."""


def plan_picture(
    circuit: Circuit, plan: StitchPlan, outline: Outline, marks: tuple[Mark, ...]
) -> bytes:
    """Draw wire, covers, needle points and cut lines; a PNG whose bytes can be made again."""
    return png_bytes(plan_figure(circuit, plan, outline, marks))


def plan_figure(
    circuit: Circuit, plan: StitchPlan, outline: Outline, marks: tuple[Mark, ...]
) -> Figure:
    """Draw wire, covers, needle points and cut lines in the one pair of axes of a figure.

    Loops are numbered in the order in which the wire reaches them, unless there are too many.
    """
    figure = Figure(figsize=_figure_size(outline, marks), layout="constrained")
    axes = figure.add_subplot()
    _draw_cut(axes, outline, marks)
    seen_mm = _PIXEL_SHARE * (outline.bounds_mm[2] - outline.bounds_mm[0])
    _draw_needles(axes, plan, seen_mm)
    _draw_thread(axes, plan, BlockKind.COVER, COVER, "thread cover")
    _draw_thread(axes, plan, BlockKind.STRIPES, STRIPE, "stripe")
    _draw_thread(axes, plan, BlockKind.TIES, TIE, "tie")
    arrow_mm = _arrow_mm(circuit, outline)
    for k, stage in enumerate(circuit.stages):
        points = stage.polyline(max(0.02, seen_mm / 2))
        _draw_wire(axes, points, stage_colour(k), f"wire, {circuit.stage_name(k)}")
        heads = list(_arrow_heads(stage, arrow_mm))
        axes.add_collection(PolyCollection(heads, facecolors=stage_colour(k), zorder=6))
    if len(circuit.layout.loops) <= _MOST_NUMBERS:
        _draw_numbers(axes, circuit)
    _draw_ends(axes, circuit)
    _finish(axes)
    return figure


def _figure_size(outline: Outline, marks: tuple[Mark, ...]) -> tuple[float, float]:
    strokes = [stroke for mark in marks for stroke in mark.strokes]
    width, height = np.ptp(np.concatenate([*outline.outsides, *strokes]), axis=0)
    # Room for the axis and for the legend underneath.
    return _WIDTH_IN, float(np.clip(_WIDTH_IN * height / width, 2.0, 2.0 * _WIDTH_IN)) + 1.0


def _arrow_mm(circuit: Circuit, outline: Outline) -> float:
    loop_mm = min(loop.width_mm for loop in circuit.layout.loops)
    return min(
        _ARROW_SHARE * (outline.bounds_mm[2] - outline.bounds_mm[0]), _LARGEST_ARROW * loop_mm
    )


def _draw_cut(axes: Axes, outline: Outline, marks: tuple[Mark, ...]) -> None:
    rings = [np.concatenate([ring, ring[:1]]) for ring in outline.rings]
    axes.add_collection(LineCollection(rings, colors=CUT, linewidths=0.6, label="cut line"))
    strokes = [stroke for mark in marks for stroke in mark.strokes]
    if strokes:
        axes.add_collection(
            LineCollection(strokes, colors=MARK, linewidths=1.2, label="registration mark")
        )


def _draw_needles(axes: Axes, plan: StitchPlan, seen_mm: float) -> None:
    """Draw a dot for each needle point; of those nearer to one another than is seen, some."""
    runs = [run.needles for block in plan.blocks if block.kind.is_wire for run in block.runs]
    if runs:
        stitch_mm = np.median(np.hypot(*np.diff(runs[0], axis=0).T)) / UNITS_PER_MM
        every = 1 + 2 * int(seen_mm / max(float(stitch_mm), seen_mm / 9))  # odd: of both sides
        x, y = np.concatenate([needles[::every] for needles in runs]).T / UNITS_PER_MM
        # Many times quicker than scatter, whose points could differ in size.
        (dots,) = axes.plot(x, y, "o", color=NEEDLE, label="needle point", zorder=2)
        dots.set_markersize(_NEEDLE_PT)
        dots.set_markeredgewidth(0)


def _draw_thread(axes: Axes, plan: StitchPlan, kind: BlockKind, colour: str, label: str) -> None:
    runs = [
        run.needles / UNITS_PER_MM
        for block in plan.blocks
        if block.kind is kind
        for run in block.runs
    ]
    if runs:
        lines = LineCollection(runs, colors=colour, linewidths=1.4, label=label, zorder=4)
        axes.add_collection(lines)


def _draw_wire(axes: Axes, points: Vectors, colour: str, label: str) -> None:
    axes.plot(points[:, 0], points[:, 1], color=colour, linewidth=1.6, label=label, zorder=5)


def _arrow_heads(path: WirePath, length_mm: float) -> Vectors:
    """Triangles (n, 3, 2), one in the middle of every stretch that bends one way."""
    ends = np.cumsum([piece.length_mm for piece in path.pieces])
    sense = np.sign([piece.curvature_per_mm for piece in path.pieces])
    ends = ends[np.append(sense[1:] != sense[:-1], True)]
    lengths = np.diff(ends, prepend=0)
    point, along = path.at((ends - lengths / 2)[lengths > 2 * length_mm])
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    back = point - length_mm / 2 * along
    corners = (point + length_mm / 2 * along, back + 0.4 * length_mm * across)
    return np.stack([*corners, back - 0.4 * length_mm * across], axis=1)


def _draw_numbers(axes: Axes, circuit: Circuit) -> None:
    loops = circuit.layout.loops
    size = float(np.clip(60 / np.sqrt(len(loops)), 4, 14))
    for number, k in enumerate(loops_in_order(circuit), start=1):
        place = (loops[k].x_mm, loops[k].y_mm)
        axes.annotate(
            str(number),
            place,
            ha="center",
            va="center",
            fontsize=size,
            color="#333333",
            zorder=4.5,  # on stripes, below wire
            bbox=_GROUND,
        )


def _draw_ends(axes: Axes, circuit: Circuit) -> None:
    """Name the free ends, beyond the wire, and the places where a stage follows on another."""
    for k, path in enumerate(circuit.stages):
        begins = circuit.begins_wire(k)
        (begin, end), (out_of, onward) = path.at([0.0, path.length_mm])
        if begins:
            _name_place(axes, begin, "start", stage_colour(k), -out_of)
        else:
            aside = np.array([out_of[1], -out_of[0]])
            _name_place(axes, begin, circuit.own_name(k), CUT, aside)
        if circuit.ends_wire(k):
            _name_place(axes, end, "end", stage_colour(k), onward)


def _name_place(axes: Axes, place: Vectors, text: str, colour: str, way: Vectors) -> None:
    """Set a dot, and a word off it in a direction."""
    x, y = place.tolist()
    axes.plot(x, y, "o", color=colour, markersize=5, zorder=7)
    axes.annotate(
        text,
        (x, y),
        xytext=(24 * float(way[0]), 14 * float(way[1])),
        textcoords="offset points",
        ha="center",
        va="center",
        color=colour,
        fontsize=9,
        zorder=8,
        bbox=_GROUND,
    )


def _finish(axes: Axes) -> None:
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.margins(0.02)
    axes.set_xlabel("x, mm, on the stretched fabric")
    axes.set_ylabel("y, mm")
    axes.spines[["top", "right"]].set_visible(False)
    axes.figure.legend(loc="outside lower center", ncols=3, frameon=False, markerscale=3)
