"""Where a design lies among flat and buckled loops: strain across, the wire's stiffness up."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from sesame_cad.report.inline_svg import dot, drawing, path, words
from solver.reading import Reading
from solver.threshold import critical_beta

Data = dict[str, Any]

_LEFT, _TOP, _WIDTH, _HEIGHT = 62.0, 14.0, 420.0, 250.0
_CURVE_POINTS = 60
_TEXT = 12.0
_STEPS = (1, 2, 2.5, 5, 10)


def phase_diagram(data: Data) -> str:
    """Draw the threshold T = 12 β and the design's points, from what `design.json` holds.

    Above the curve the wire is too stiff for the fabric, and the loop is flat.
    """
    strain, points = data["strain"], (("cold", data["beta"]), ("hot", data["beta_hot"]))
    reading, poisson = Reading(data["reading"]), data["poisson"]
    largest = 1.3 * strain
    strains = np.linspace(0, largest, _CURVE_POINTS)
    betas = [critical_beta(float(one), poisson, reading) for one in strains]
    highest = 1.1 * max([*betas, *(beta for _, beta in points)])
    label = f"β of {points[0][1]:.4g} cold and {points[1][1]:.4g} hot at a strain of {strain:g}"

    def place(at: float, beta: float) -> tuple[float, float]:
        return _LEFT + _WIDTH * at / largest, _TOP + _HEIGHT * (1 - beta / highest)

    curve = [place(float(one), beta) for one, beta in zip(strains, betas, strict=True)]
    line = "M" + "L".join(f"{x:.2f},{y:.2f}" for x, y in curve)
    corner = f"L{_LEFT + _WIDTH:g},{_TOP + _HEIGHT:g}L{_LEFT:g},{_TOP + _HEIGHT:g}Z"
    parts = [
        path(line + corner, "buckled"),
        *_axes(largest, highest),
        path(line, "threshold"),
        words((_LEFT + 10, _TOP + 18), _TEXT, "flat: β over T/12", anchor="start"),
        words((_LEFT + _WIDTH - 10, _TOP + _HEIGHT - 10), _TEXT, "buckled: saddles", anchor="end"),
    ]
    for name, beta in points:
        x, y = place(strain, beta)
        parts.append(dot((x, y), 5, f"point {name}", f"{name}: β = {beta:.4g}"))
        parts.append(words((x + 9, y + 4), _TEXT, f"{name}, β {beta:.4f}", anchor="start"))
    return drawing(_LEFT + _WIDTH + 60, _TOP + _HEIGHT + 46, label, parts, style="diagram")


def _axes(largest: float, highest: float) -> Iterator[str]:
    foot, right = _TOP + _HEIGHT, _LEFT + _WIDTH
    yield path(f"M{_LEFT:g},{_TOP:g}V{foot:g}H{right:g}", "axis")
    for value in _ticks(largest):
        x = _LEFT + _WIDTH * value / largest
        yield path(f"M{x:.2f},{foot:g}v5", "axis")
        yield words((x, foot + 18), _TEXT, f"{100 * value:g} %")
    for value in _ticks(highest):
        y = _TOP + _HEIGHT * (1 - value / highest)
        yield path(f"M{_LEFT:g},{y:.2f}h-5", "axis")
        yield words((_LEFT - 8, y + 4), _TEXT, f"{value:g}", anchor="end")
    yield words((_LEFT + _WIDTH / 2, foot + 38), _TEXT, "strain of the fabric in the hoop")
    yield words((14, _TOP + _HEIGHT / 2), _TEXT, "β, the wire's stiffness", turn=-90)


def _ticks(largest: float) -> list[float]:
    """Round numbers from 0, four to eight of them."""
    power = 10.0 ** np.floor(np.log10(largest / 5))
    step = next(power * k for k in _STEPS if largest / (power * k) <= 7)
    return [float(f"{k * step:.6g}") for k in range(int(largest / step) + 1)]
