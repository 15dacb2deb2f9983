"""What an actuation comes to: its work, its end, and what keeps it from working."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from patterns.electrics import Supply
from sesame_cad.actuation.course import Actuation

Data = dict[str, Any]

THREAD_MELTS_C = 250.0
"""Polyester, of which embroidery thread is made, melts from about here on (250 to 260 °C)."""

_SMALL = 0.01
"""A fraction of austenite below this is none."""


def flattened_at(made: Actuation) -> Data | None:
    """When and where the load flattens the array."""
    heights, place = made.loaded
    if place is None or heights.size == 0:
        return None
    course = made.history.course
    return {
        "time_s": float(course.time_s[place]),
        "temperature_C": float(course.temperature_C[place]),
        "austenite_fraction": float(course.fraction[place]),
    }


def work_J(made: Actuation) -> float:  # noqa: N802 - the unit's own spelling
    """What the array lifts the slab by in the last cycle, on its way up; none once flattened."""
    if made.loaded[1] is not None:
        return 0.0
    rises = np.maximum(np.diff(made.loaded[0][made.last_cycle]), 0.0)
    return made.load_N * float(rises.sum()) / 1e3


def supply_faults(made: Actuation) -> tuple[str, ...]:
    """Say what the supply lacks to drive the array."""
    supply = Supply(made.spec.supply.voltage_V, made.spec.supply.current_A)
    return made.body.supply_faults(supply, made.duty.current_A)


def warnings(made: Actuation) -> Iterator[str]:
    """Say in a line each what keeps the array from working as an actuator."""
    law, heat = made.wire.transformation, made.spec.actuation
    for fault in supply_faults(made):
        yield f"the supply cannot drive the array: {fault}"
    if made.start.fraction > 1 - _SMALL:
        yield f"at {heat.ambient_C:g} C the wire is hot before any current flows"
    elif made.history.course.fraction.max() < made.start.fraction + _SMALL:
        yield (
            f"the wire does not transform: it reaches {made.history.course.temperature_C.max():.1f}"
            f" C, and austenite begins at {law.austenite_start_C:g} C"
        )
    highest_C = float(made.history.course.temperature_C.max())  # noqa: N806
    if highest_C > THREAD_MELTS_C:
        yield (
            f"the wire reaches {highest_C:.0f} C, and polyester thread melts at "
            f"{THREAD_MELTS_C:g} C; lower wire.current_A or actuation.heating_s"
        )
    stays = float(law.cooled(heat.ambient_C))
    if stays > _SMALL:
        yield (
            f"once heated the wire stays hot: it cools to {heat.ambient_C:g} C, where "
            f"{100 * stays:.0f} % is still austenite, and turns back from "
            f"{law.martensite_start_C:g} to {law.martensite_finish_C:g} C; take wire of a higher "
            "transition, or check actuation.hysteresis_C"
        )
    snap = flattened_at(made)
    if snap is not None:
        yield (
            f"the load flattens the array after {snap['time_s']:.3g} s, at "
            f"{snap['temperature_C']:.1f} C, and it stays flat as long as the load lies on it"
        )
