"""A line of a cut file as all such files can hold it: vertices with bulges, or a circle."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import pi

import numpy as np
from numpy.typing import NDArray

from patterns.contour import Contour
from patterns.cut_order import Cut
from patterns.cut_piece import Hole
from patterns.path import Line, Piece

HOLE, CUT = "HOLE", "CUT"
"""Layers: lines inside a piece, which are cut first, and outsides."""

TOLERANCE_MM = 0.005
"""Cut files hold three decimals at least."""


@dataclass(frozen=True)
class CutLine:
    """A line of straight and circular pieces, or a circle.

    Attributes
    ----------
    layer : str
    closed : bool
    vertices : array (n, 3)
        x, y in mm and the bulge of the piece that begins there, as in `patterns.contour`; of a
        circle, its centre and its diameter in one row.
    """

    layer: str
    closed: bool
    vertices: NDArray[np.float64]

    @property
    def is_circle(self) -> bool:
        """Whether it is a circle."""
        return len(self.vertices) == 1

    def same_as(self, other: CutLine) -> bool:
        """Whether two lines are the same to within the tolerance, arcs by their height too."""
        if self.layer != other.layer or self.closed != other.closed:
            return False
        if self.vertices.shape != other.vertices.shape:
            return False
        return bool(np.all(np.abs(self._measured() - other._measured()) <= TOLERANCE_MM))

    def _measured(self) -> NDArray[np.float64]:
        """Vertices with the height of each arc over its chord instead of its bulge."""
        if self.is_circle:
            return self.vertices
        ends = np.roll(self.vertices, -1, axis=0)
        chord = np.hypot(*(ends[:, :2] - self.vertices[:, :2]).T)
        heights = self.vertices[:, 2] * chord / 2
        if not self.closed:
            heights[-1] = 0.0
        return np.column_stack([self.vertices[:, :2], heights])


def cut_line(cut: Cut) -> CutLine:
    """Give the line of a cut: closed, or open where it goes on through an overcut."""
    layer = HOLE if cut.inner else CUT
    if not cut.overcut_mm:
        if isinstance(cut.line, Hole):
            hole = cut.line
            return CutLine(layer, True, np.array([[hole.x_mm, hole.y_mm, hole.diameter_mm]]))
        return CutLine(layer, True, cut.line.vertices())
    pieces = tuple(part for piece in cut.way.pieces for part in _halves(piece))
    (end,), _ = pieces[-1].at(np.array([pieces[-1].length_mm]))
    return CutLine(layer, False, np.concatenate([Contour(pieces).vertices(), [[*end, 0.0]]]))


def _halves(piece: Piece) -> tuple[Piece, ...]:
    """Halve a whole turn: no bulge stands for one."""
    if isinstance(piece, Line) or abs(piece.sweep_rad) <= pi:
        return (piece,)
    half = replace(piece, sweep_rad=piece.sweep_rad / 2)
    return half, replace(half, start_rad=piece.start_rad + half.sweep_rad)


def same_lines(lines: Sequence[CutLine], expected: Sequence[CutLine]) -> bool:
    """Whether all lines are those that are expected, in their order."""
    return len(lines) == len(expected) and all(
        one.same_as(other) for one, other in zip(lines, expected, strict=True)
    )
