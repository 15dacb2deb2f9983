"""Height over two swept numbers, with the analytic threshold and where no real loop is."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from sesame_cad.measured import FIG_2_POINTS, TABLE_1_POINTS, FigurePoint
from sesame_cad.pictures.canvas import png_bytes
from sesame_cad.sweeps.axis import Axis
from sesame_cad.sweeps.outcome import Outcome
from solver.reading import Reading
from solver.threshold import critical_strain, line_tension

Vectors = NDArray[np.float64]

_SIZE_IN = (7.6, 5.4)
_STEPS = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05)
_MOST_LEVELS = 18
_CURVE_POINTS = 400
_THRESHOLD, _INK, _UNPHYSICAL = "#D55E00", "#222222", "#FFFFFF"
_NOTHING = "#AAAAAA"
"""Where there is no height."""
_NAMES = {
    "beta": "β, bending stiffness of the wire over stiffness of the fabric",
    "strain": "ε, prestrain of the fabric",
    "poisson": "ν, Poisson's ratio of the fabric",
}
_HEIGHT = "height over wire length, h/(π d₀)"


def axis_name(key: str) -> str:
    """Name a key on an axis."""
    return _NAMES.get(key, key)


def phase_diagram(
    axes: tuple[Axis, ...], outcomes: Sequence[Outcome], reading: Reading, title: str
) -> bytes | None:
    """Draw the heights of a sweep of one or two keys; None where there is no such picture.

    Parameters
    ----------
    axes : tuple of Axis
        Those of more than one value; the last varies fastest.
    outcomes : sequence of Outcome
        At each point, in the order of the table.
    """
    if len(axes) == 2:
        return png_bytes(_contour_figure(axes, outcomes, reading, title))
    if len(axes) == 1:
        return png_bytes(_line_figure(axes[0], outcomes, title))
    return None


def _heights(outcomes: Sequence[Outcome]) -> Vectors:
    """Heights, nan where there is none."""
    found = [one.height_over_perimeter for one in outcomes]
    return np.array([np.nan if height is None else height for height in found], dtype=float)


def _contour_figure(
    axes: tuple[Axis, ...], outcomes: Sequence[Outcome], reading: Reading, title: str
) -> Figure:
    """Contours; β goes to the right, as in the paper, and else the axis that varies fastest."""
    up, right = axes
    shape = (len(up.values), len(right.values))
    height = _heights(outcomes).reshape(shape)
    unphysical = np.array([not one.physical for one in outcomes]).reshape(shape)
    excess = _excess(outcomes, reading).reshape(shape)
    if up.key == "beta":
        up, right = right, up
        height, unphysical, excess = height.T, unphysical.T, excess.T
    figure = Figure(figsize=_SIZE_IN, layout="constrained")
    panel = figure.add_subplot()
    x, y = np.array(right.values), np.array(up.values)
    handles: list[Any] = []
    _draw_heights(figure, panel, x, y, height)
    _draw_unphysical(panel, x, y, unphysical, handles)
    handles += _draw_threshold(panel, (right, up), outcomes, excess, reading)
    if (right.key, up.key) == ("beta", "strain"):
        _draw_points(panel, x, y, FIG_2_POINTS, handles)
        if reading is Reading.PLANE_STRESS:
            # with the β of Table I, as the paper's own formula gives it
            _draw_points(panel, x, y, TABLE_1_POINTS, handles)
    panel.set(xlabel=axis_name(right.key), ylabel=axis_name(up.key))
    panel.set_title(title, fontsize=10, color=_INK)
    panel.set_xlim(x.min(), x.max())
    panel.set_ylim(y.min(), y.max())
    figure.legend(handles=handles, loc="outside lower center", ncols=2, fontsize=8, frameon=False)
    return figure


def _draw_heights(figure: Figure, panel: Axes, x: Vectors, y: Vectors, height: Vectors) -> None:
    top = float(np.nanmax(height)) if np.isfinite(height).any() else 0.0
    step = next((one for one in _STEPS if top <= _MOST_LEVELS * one), _STEPS[-1])
    panel.set_facecolor(_NOTHING)
    levels = step * np.arange(max(2, int(np.ceil(top / step)) + 1))
    drawn = panel.contourf(x, y, np.ma.masked_invalid(height), levels=levels, cmap="viridis")
    bar = figure.colorbar(drawn, ax=panel, format="%.2f")
    bar.set_label(_HEIGHT)


def _draw_unphysical(
    panel: Axes, x: Vectors, y: Vectors, unphysical: NDArray[np.bool_], handles: list[Any]
) -> None:
    """Hatch the points themselves, each as far as half-way to the next."""
    count = int(unphysical.sum())
    if not count:
        return
    for i, first, last in _runs(unphysical):
        (left, _), (_, right), (low, high) = _cell(x, first), _cell(x, last), _cell(y, i)
        panel.fill(
            [left, right, right, left],
            [low, low, high, high],
            facecolor="none",
            edgecolor=_UNPHYSICAL,
            hatch="////",
            linewidth=0,
        )
    label = f"unphysical: fabric slack, loop meets itself, or unsolved ({count} points)"
    handles.append(Patch(facecolor="#3B528B", edgecolor=_UNPHYSICAL, hatch="////", label=label))


def _runs(marked: NDArray[np.bool_]) -> list[tuple[int, int, int]]:
    """Give row, first and last column of each unbroken run: far fewer to draw than points."""
    edges = np.diff(np.pad(marked, ((0, 0), (1, 1))).astype(np.int8), axis=1)
    starts, ends = np.argwhere(edges == 1), np.argwhere(edges == -1)
    return [(i, j, k - 1) for (i, j), (_, k) in zip(starts.tolist(), ends.tolist(), strict=True)]


def _cell(values: Vectors, k: int) -> tuple[float, float]:
    own = values[k]
    before, after = values[max(k - 1, 0)], values[min(k + 1, len(values) - 1)]
    return float((own + before) / 2), float((own + after) / 2)


def _excess(outcomes: Sequence[Outcome], reading: Reading) -> Vectors:
    """T − 12 β at each point, nan where it is not known."""
    found = [
        np.nan
        if one.strain is None or one.beta is None or one.poisson is None
        else line_tension(one.strain, one.poisson, reading) - 12 * one.beta
        for one in outcomes
    ]
    return np.array(found, dtype=float)


def _draw_threshold(
    panel: Axes,
    sides: tuple[Axis, Axis],
    outcomes: Sequence[Outcome],
    excess: Vectors,
    reading: Reading,
) -> list[Any]:
    """T = 12 β: from the formula over strain and β, else by the formula at the points."""
    right, up = sides
    poisson = outcomes[0].poisson
    if (right.key, up.key) == ("beta", "strain") and poisson is not None:
        beta = np.linspace(min(right.values), max(right.values), _CURVE_POINTS)
        strain = [critical_strain(value, poisson, reading) for value in beta.tolist()]
        panel.plot(beta, strain, color=_THRESHOLD, linewidth=2)
    elif (excess < 0).any() and (excess > 0).any():
        panel.contour(
            np.array(right.values),
            np.array(up.values),
            np.ma.masked_invalid(excess),
            levels=[0.0],
            colors=[_THRESHOLD],
            linewidths=2,
        )
    else:
        return []
    label = "threshold T = 12 β, analytic"
    return [Line2D([], [], color=_THRESHOLD, linewidth=2, label=label)]


def _draw_points(
    panel: Axes, x: Vectors, y: Vectors, points: Sequence[FigurePoint], handles: list[Any]
) -> None:
    for point in points:
        if not (x.min() <= point.beta <= x.max() and y.min() <= point.strain <= y.max()):
            continue
        look: dict[str, Any] = {
            "marker": point.marker,
            "color": point.face,
            "markeredgecolor": "#000000" if point.face != "#000000" else "#FFFFFF",
            "markersize": 9,
            "linestyle": "none",
        }
        panel.plot([point.beta], [point.strain], **look)
        handles.append(Line2D([], [], label=point.label, **look))


def _line_figure(axis: Axis, outcomes: Sequence[Outcome], title: str) -> Figure:
    """Height along one axis."""
    figure = Figure(figsize=_SIZE_IN, layout="constrained")
    panel = figure.add_subplot()
    x, height = np.array(axis.values), _heights(outcomes)
    physical = np.array([one.physical for one in outcomes])
    panel.plot(x, np.where(physical, height, np.nan), ".-", color="#0072B2", label="height")
    if not physical.all():
        label = "unphysical: slack, self-meeting or unsolved"
        panel.plot(x[~physical], height[~physical], "x", color=_THRESHOLD, label=label)
        panel.legend(fontsize=8, frameon=False)
    panel.set(xlabel=axis_name(axis.key), ylabel=_HEIGHT)
    panel.set_title(title, fontsize=10, color=_INK)
    return figure
