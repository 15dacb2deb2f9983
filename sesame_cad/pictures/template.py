"""The page to lay under the hoop: the outline with the hoop's centre, 1:1 where it fits."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from numpy.typing import NDArray
from shapely import LineString

from sesame_cad.drawing_colours import MARK, stage_colour
from sesame_cad.files.sheet import CHECK_BAR_MM
from sesame_cad.pictures.paper import MARGIN_MM, blank_page, write_text
from sesame_cad.pipeline import Pattern

Vectors = NDArray[np.float64]

CUT = "#ff0000"
CENTRE_MM = 10.0
"""Size of the cross in the centre."""

_SCALES = (1, 2, 3, 4, 5, 10, 20, 50, 100, 200, 500, 1000)
_WORDS_MM = 18.0
"""Above and below the drawing, for the title and the bar."""

_CHORD_MM = 0.02
"""Largest distance on paper between drawn chords and a curve, where it is not 1:1."""


@dataclass(frozen=True, slots=True)
class _Fit:
    """How a design lies on a page: design coordinates, divided by the scale, from a corner."""

    scale: int
    size_mm: tuple[float, float]
    origin_mm: Vectors

    def holds(self, extent_mm: Vectors) -> bool:
        """Whether there is room for a drawing of some width and height."""
        room = np.array(self.size_mm) - 2 * MARGIN_MM - (0.0, 2 * _WORDS_MM)
        return bool(np.all(extent_mm / self.scale <= room))

    def on_page(self, line: Vectors) -> Vectors:
        """Turn the design's coordinates into the page's."""
        chords = line
        if self.scale > 1:
            chords = np.array(LineString(line).simplify(_CHORD_MM * self.scale).coords)
        return self.origin_mm + chords / self.scale


def template_page(laid: Pattern, name: str, size_mm: tuple[float, float]) -> Axes:
    """Draw outline, wire, marks and the hoop's centre, on the page upright or turned.

    Parameters
    ----------
    size_mm
        Width and height of the paper, upright.
    """
    fit = _fit(_strokes(laid), size_mm)
    axes = blank_page(*fit.size_mm)
    with rc_context({"path.simplify": False}):  # which moves lines by up to 0.04 mm
        _draw_pattern(axes, fit, laid)
    _draw_centre(axes, fit)
    scale = "1:1, print without fitting to the page" if fit.scale == 1 else f"scale 1:{fit.scale}"
    top = fit.size_mm[1] - MARGIN_MM - 5.0
    write_text(axes, (MARGIN_MM, top), f"{name}: stretched outline, {scale}", 10.0, "bold")
    _draw_bar(axes)
    return axes


def _draw_pattern(axes: Axes, fit: _Fit, laid: Pattern) -> None:
    _draw(axes, fit, [_closed(ring) for ring in laid.outline.rings], CUT, 0.5)
    for k, stage in enumerate(laid.circuit.stages):
        _draw(axes, fit, [stage.polyline(_CHORD_MM)], stage_colour(k), 0.5)
    _draw(axes, fit, [stroke for mark in laid.marks for stroke in mark.strokes], MARK, 0.5)


def _strokes(laid: Pattern) -> Vectors:
    """Everything that must be on the page, and the hoop's centre."""
    marks = [stroke for mark in laid.marks for stroke in mark.strokes]
    return np.concatenate([*laid.outline.outsides, *marks, np.zeros((1, 2))])


def _fit(points: Vectors, upright_mm: tuple[float, float]) -> _Fit:
    """Take the largest scale at which the drawing fits, turned only if upright is too small."""
    low, high = points.min(axis=0), points.max(axis=0)
    width, height = upright_mm
    fits = [
        _Fit(scale, size, np.array(size) / 2 - (low + high) / 2 / scale)
        for scale in _SCALES
        for size in ((width, height), (height, width))
    ]
    return next((fit for fit in fits if fit.holds(high - low)), fits[-1])


def _closed(ring: Vectors) -> Vectors:
    return np.concatenate([ring, ring[:1]])


def _draw(axes: Axes, fit: _Fit, lines: list[Vectors], colour: str, width_pt: float) -> None:
    drawn = [fit.on_page(line) for line in lines]
    axes.add_collection(
        LineCollection(drawn, colors=colour, linewidths=width_pt, clip_on=False), autolim=False
    )


def _draw_centre(axes: Axes, fit: _Fit) -> None:
    arms = [fit.origin_mm + CENTRE_MM / 2 * arm for arm in _cross()]
    axes.add_collection(LineCollection(arms, colors=MARK, linewidths=0.7), autolim=False)


def _cross() -> Iterator[Vectors]:
    yield np.array([(-1.0, 0.0), (1.0, 0.0)])
    yield np.array([(0.0, -1.0), (0.0, 1.0)])


def _draw_bar(axes: Axes) -> None:
    """Draw a bar by which to see that the printer kept the size."""
    y = MARGIN_MM + 4.0
    bar = [(MARGIN_MM, y), (MARGIN_MM + CHECK_BAR_MM, y)]
    ticks = [[(x, y - 1.5), (x, y + 1.5)] for x, _ in bar]
    lines = LineCollection([bar, *ticks], colors=MARK, linewidths=0.7)
    axes.add_collection(lines, autolim=False)
    write_text(axes, (MARGIN_MM, y + 2.5), f"{CHECK_BAR_MM:g} mm on this paper", 7.0)
