"""The page around a cut file's lines."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from patterns.loop_ring import Ring
from patterns.outline import Outline
from patterns.registration import Mark

CHECK_BAR_MM = 100.0
"""Importers assume 72, 90 or 96 dots an inch: a bar of known length shows which."""

MARGIN_MM = 5.0


@dataclass(frozen=True)
class Sheet:
    """A page, and where on it the design lies.

    Attributes
    ----------
    left_mm, top_mm : float
        The page's upper left corner in the design's coordinates, y up.
    width_mm, height_mm : float
        Size of the page.
    check_bar : Ring
        Its two ends, in the design's coordinates; below everything else.
    """

    left_mm: float
    top_mm: float
    width_mm: float
    height_mm: float
    check_bar: Ring

    def on_page(self, line: Ring) -> Ring:
        """Turn the design's coordinates into the page's: from its upper left corner, y down."""
        return np.stack([line[:, 0] - self.left_mm, self.top_mm - line[:, 1]], axis=1)

    def off_page(self, line: Ring) -> Ring:
        """Turn the page's coordinates into the design's."""
        return np.stack([line[:, 0] + self.left_mm, self.top_mm - line[:, 1]], axis=1)


def lay_out(outline: Outline, marks: tuple[Mark, ...]) -> Sheet:
    """Choose a page around outline and marks, with the check bar below them."""
    strokes = [stroke for mark in marks for stroke in mark.strokes]
    return lay_out_points(np.concatenate([*outline.outsides, *strokes]))


def lay_out_points(points: Ring) -> Sheet:
    """Choose a page around points (n, 2), with the check bar below them."""
    left, bottom = np.floor(points.min(axis=0)) - MARGIN_MM
    right, top = np.ceil(points.max(axis=0)) + MARGIN_MM
    bar = np.array([(left + MARGIN_MM, bottom), (left + MARGIN_MM + CHECK_BAR_MM, bottom)])
    right = max(right, bar[1, 0] + MARGIN_MM)
    bottom -= MARGIN_MM
    return Sheet(float(left), float(top), float(right - left), float(top - bottom), bar)
