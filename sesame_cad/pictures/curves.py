"""Curves, one panel above the other, over one axis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from sesame_cad.pictures.canvas import png_bytes

Vectors = NDArray[np.float64]

COLD, HOT, NEUTRAL, SHADE = "#0072B2", "#D55E00", "#333333", "#DDDDDD"

_WIDTH_IN, _PANEL_IN, _AXIS_IN = 7.5, 2.3, 0.9


@dataclass(frozen=True, eq=False)
class Line:
    """One curve; where y is not a number it is interrupted."""

    x: Vectors
    y: Vectors
    name: str = ""
    colour: str = NEUTRAL
    dashed: bool = False
    marked: bool = False


@dataclass(frozen=True)
class Panel:
    """Curves of one quantity.

    Attributes
    ----------
    quantity : str
        With its unit.
    lines : sequence of Line
    levels : sequence of (float, str)
        Values that are marked, with their names.
    """

    quantity: str
    lines: Sequence[Line]
    levels: Sequence[tuple[float, str]] = field(default=())


def curves_picture(
    title: str, abscissa: str, panels: Sequence[Panel], spans: Sequence[tuple[float, float]] = ()
) -> bytes:
    """Draw panels over one axis; a PNG whose bytes can be made again.

    Parameters
    ----------
    abscissa : str
        What is to the right, with its unit.
    spans : sequence of (float, float)
        Stretches of it that are shaded.
    """
    figure = Figure(figsize=(_WIDTH_IN, _PANEL_IN * len(panels) + _AXIS_IN), layout="constrained")
    axes = np.atleast_1d(figure.subplots(len(panels), 1, sharex=True))
    for own, panel in zip(axes, panels, strict=True):
        _draw(own, panel, spans)
    axes[0].set_title(title, fontsize=11)
    axes[-1].set_xlabel(abscissa)
    return png_bytes(figure)


def _draw(axes: Axes, panel: Panel, spans: Sequence[tuple[float, float]]) -> None:
    for begin, end in spans:
        axes.axvspan(begin, end, color=SHADE, linewidth=0, zorder=0)
    for line in panel.lines:
        axes.plot(
            line.x,
            line.y,
            color=line.colour,
            linestyle="--" if line.dashed else "-",
            marker="o" if line.marked else None,
            markersize=4,
            linewidth=1.6,
            label=line.name or None,
        )
    for level, name in panel.levels:
        axes.axhline(level, color="#777777", linewidth=0.8, linestyle=":")
        axes.annotate(
            name,
            (1.0, level),
            xycoords=("axes fraction", "data"),
            xytext=(-3, 2),
            textcoords="offset points",
            ha="right",
            fontsize=8,
            color="#555555",
        )
    axes.set_ylabel(panel.quantity)
    axes.grid(color="#EEEEEE", linewidth=0.6)
    axes.set_axisbelow(True)
    if any(line.name for line in panel.lines):
        axes.legend(fontsize=8, loc="best")
