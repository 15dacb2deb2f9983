"""The released array, cold and hot, side by side at one scale."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from numpy.typing import NDArray

from sesame_cad.pictures.canvas import DOTS_PER_INCH, png_bytes
from sesame_cad.pictures.rendering import (
    AnyPatch,
    View,
    chain_patch,
    fabric_patch,
    piece_patch,
    projected_bounds,
    render,
    wire_patch,
)
from sesame_cad.sheet_shape import SheetShape
from sesame_cad.solids import Surface

Vectors = NDArray[np.float64]

FABRIC, WIRE, INK = "#8DB4D6", "#E8651F", "#333333"

_WIDTH_IN, _TITLE_IN, _MARGIN_IN = 13.0, 0.4, 0.1
_BAR_LENGTHS_MM = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)
_LARGEST_SHARE_IN = 6.5
_LARGEST_ASPECT = 2.0
_AIR = 1.03


@dataclass(frozen=True)
class ShapeView:
    """One state of an array.

    Attributes
    ----------
    title : str
        Stands above its picture.
    surface : callable
        A loop's fabric: from radius (n,) in 0..1 and angle (n,) to points (n, 3) in mm; radius 1
        is the wire.
    centres_mm : array, shape (n, 2)
        Where the loops stand.
    wire_diameter_mm : float
        Drawn at its true size.
    """

    title: str
    surface: Surface
    centres_mm: Vectors
    wire_diameter_mm: float


@dataclass(frozen=True)
class SheetView:
    """One state of an array whose loops differ.

    Attributes
    ----------
    title : str
    shape : SheetShape
        Its wires are drawn at their true size.
    """

    title: str
    shape: SheetShape

    @property
    def centres_mm(self) -> Vectors:
        """Where it stands: it is drawn once."""
        return np.zeros((1, 2))


@dataclass(frozen=True)
class PatchView:
    """One state of anything else.

    Attributes
    ----------
    title : str
    patches : tuple of patches
        In mm, each with its colour.
    """

    title: str
    patches: tuple[AnyPatch, ...]

    @property
    def centres_mm(self) -> Vectors:
        """Where it stands: it is drawn once."""
        return np.zeros((1, 2))


AnyView = ShapeView | SheetView | PatchView

_FROM_ABOVE = View()


def shapes_picture(views: Sequence[AnyView], view: View = _FROM_ABOVE, air: float = _AIR) -> bytes:
    """Draw states of an array side by side, at one scale, seen from one side; a PNG.

    Parameters
    ----------
    air : float
        The picture is this much larger than what it shows.
    """
    patches = [_patches(shape) for shape in views]
    bounds = [
        projected_bounds(own, shape.centres_mm, view)
        for own, shape in zip(patches, views, strict=True)
    ]
    extent = air * np.max([high - low for low, high in bounds], axis=0)
    share_in = min(_WIDTH_IN / len(views), _LARGEST_SHARE_IN)
    width_in = share_in - 2 * _MARGIN_IN
    mm_per_inch = max(extent[0] / width_in, extent[1] / (_LARGEST_ASPECT * width_in))
    height_in = extent[1] / mm_per_inch + 2 * _MARGIN_IN
    size = (round(height_in * DOTS_PER_INCH), round(width_in * DOTS_PER_INCH))
    mm_per_pixel = mm_per_inch / DOTS_PER_INCH
    figure = Figure(figsize=(share_in * len(views), size[0] / DOTS_PER_INCH + _TITLE_IN))
    for k, (shape, own, (low, high)) in enumerate(zip(views, patches, bounds, strict=True)):
        corner = (low + high) / 2 - mm_per_pixel * np.array([size[1], size[0]]) / 2
        image = render(
            own, shape.centres_mm, view, corner_mm=corner, mm_per_pixel=mm_per_pixel, size=size
        )
        axes = _axes(figure, size, _MARGIN_IN + k * share_in)
        axes.imshow(image, interpolation="none", aspect="auto")
        axes.set_title(shape.title, fontsize=13, color=INK)
    _scale_bar(figure.axes[0], size, mm_per_pixel)
    return png_bytes(figure)


def _patches(shape: AnyView) -> list[AnyPatch]:
    if isinstance(shape, PatchView):
        return list(shape.patches)
    fabric, wire = (np.array(to_rgb(colour)) for colour in (FABRIC, WIRE))
    if isinstance(shape, SheetView):
        drawn = shape.shape
        return [
            *(piece_patch(piece, fabric) for piece in drawn.pieces),
            *(
                chain_patch(chain, thick, wire)
                for chain, thick in zip(drawn.wires, drawn.diameters_mm, strict=True)
            ),
        ]
    return [
        fabric_patch(shape.surface, fabric),
        wire_patch(shape.surface, shape.wire_diameter_mm, wire),
    ]


def _axes(figure: Figure, size: tuple[int, int], left_in: float) -> Axes:
    """Axes of exactly the picture's pixels."""
    width, height = figure.get_size_inches()
    columns_in, rows_in = size[1] / DOTS_PER_INCH, size[0] / DOTS_PER_INCH
    axes = figure.add_axes((left_in / width, 0.0, columns_in / width, rows_in / height))
    axes.set_axis_off()
    return axes


def _scale_bar(axes: Axes, size: tuple[int, int], mm_per_pixel: float) -> None:
    """Draw a round length across the view, which shortens nothing in that direction."""
    quarter_mm = size[1] * mm_per_pixel / 4
    length_mm = max((b for b in _BAR_LENGTHS_MM if b <= quarter_mm), default=_BAR_LENGTHS_MM[0])
    left, row = 12, size[0] - 12
    axes.plot([left, left + length_mm / mm_per_pixel], [row, row], color=INK, linewidth=2.5)
    axes.text(left, row - 8, f"{length_mm} mm", color=INK, fontsize=11, va="bottom")
