"""What was found for what was wanted, as plain data."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from sesame_cad.fitting.actuator import CHOICES, QUANTITIES, Parts, action
from sesame_cad.fitting.search import Answer, Bounds, fit
from solver.errors import NotConvergedError, SceneError

_AT_BOUND = 1e-4


def answer_data(answer: Answer, parts: Parts, bounds: Bounds) -> dict[str, Any]:
    """Everything that the choice does, whether it was wanted or not."""
    try:
        values = action(parts, answer.choice, QUANTITIES).values
    except (SceneError, NotConvergedError):
        values = answer.action.values
    return {
        **dict(zip(CHOICES, answer.choice.tolist(), strict=True)),
        **{key: values.get(key) for key in QUANTITIES},
        "beta": answer.action.cold.found.scene.beta,
        "reached": answer.reached,
        "largest_error": answer.error,
        "height_spread": answer.action.height_spread,
        "slack": answer.action.slack,
        "at_bounds": _at_bounds(answer, bounds),
    }


def _at_bounds(answer: Answer, bounds: Bounds) -> list[str]:
    """Choices that would have gone farther."""
    wires = (min(bounds.wires_mm), max(bounds.wires_mm)) if bounds.any_wire else (0.0, 0.0)
    limits = dict(zip(CHOICES, (bounds.loop_diameter_mm, wires, bounds.prestrain), strict=True))
    return [
        key
        for key, value in zip(CHOICES, answer.choice.tolist(), strict=True)
        if limits[key][0] < limits[key][1]
        and min(abs(value / limit - 1) for limit in limits[key]) < _AT_BOUND
    ]


def fit_data(
    parts: Parts, wanted: Mapping[str, float], bounds: Bounds, within: float, most: int
) -> dict[str, Any]:
    """Find the best answers; those that reach what is wanted alone, if there are any."""
    answers = fit(parts, wanted, bounds, within)
    reached = [answer for answer in answers if answer.reached]
    return {
        "wanted": dict(wanted),
        "within": within,
        "feasible": bool(reached),
        "answers": [answer_data(answer, parts, bounds) for answer in (reached or answers)[:most]],
    }


def map_data(
    parts: Parts,
    heights_mm: Sequence[Sequence[float]],
    pitch_mm: float,
    bounds: Bounds,
    within: float,
) -> dict[str, Any]:
    """Fit each cell of a map of heights, all of one pitch; equal heights have equal answers."""
    known: dict[float, dict[str, Any]] = {}
    for height in sorted({height for row in heights_mm for height in row}):
        wanted = {"height_mm": height, "pitch_mm": pitch_mm}
        found = fit_data(parts, wanted, bounds, within, 1)
        known[height] = {"feasible": found["feasible"], **next(iter(found["answers"]), {})}
    cells = [
        {"row": i + 1, "column": j + 1, "wanted_height_mm": height, **known[height]}
        for i, row in enumerate(heights_mm)
        for j, height in enumerate(row)
    ]
    return {
        "pitch_mm": pitch_mm,
        "within": within,
        "feasible": all(cell["feasible"] for cell in cells),
        "cells": cells,
        "left_out": (
            "each cell's shape is that of its loop alone: loops that differ bend each other where "
            "they touch, which only a coupled shape knows"
        ),
    }
