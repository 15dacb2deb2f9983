"""Curves of forces as tables and pictures."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from sesame_cad.actuation.force import ForcePoint, TemperaturePoint, Vice
from sesame_cad.files.table_csv import table_csv
from sesame_cad.pictures.curves import COLD, HOT, Line, Panel, curves_picture

Values = NDArray[np.float64]


def gap_files(
    held: Vice, cold: Sequence[ForcePoint], hot: Sequence[ForcePoint]
) -> dict[str, bytes]:
    """Force against gap, cold and hot."""
    gaps = [point.gap_mm for point in cold]
    columns = {
        "gap_mm": gaps,
        "force_cold_N": [_force(held, point) for point in cold],
        "force_hot_N": [_force(held, point) for point in hot],
        "status_cold": [point.status for point in cold],
        "status_hot": [point.status for point in hot],
    }
    lines = [
        Line(np.array(gaps), _forces(held, points), name, colour, marked=True)
        for points, name, colour in ((cold, "cold", COLD), (hot, "hot", HOT))
    ]
    picture = curves_picture(
        f"{held.spec.name}: force of one loop between plates, {held.axis}",
        f"gap in mm, to the wire's {held.measured_to}",
        [Panel("force in N", lines)],
    )
    return {"curves/gap.csv": table_csv(columns).encode(), "pictures/gap.png": picture}


def temperature_files(held: Vice, points: Sequence[TemperaturePoint]) -> dict[str, bytes]:
    """Force against temperature at one gap, both ways."""
    columns = {
        "way": [one.way for one in points],
        "temperature_C": [one.temperature_C for one in points],
        "austenite_fraction": [one.point.fraction for one in points],
        "force_N": [_force(held, one.point) for one in points],
        "status": [one.point.status for one in points],
    }
    lines = [
        Line(
            np.array([one.temperature_C for one in points if one.way == way]),
            _forces(held, [one.point for one in points if one.way == way]),
            way,
            colour,
            marked=True,
        )
        for way, colour in (("heating", HOT), ("cooling", COLD))
    ]
    gap_mm = points[0].point.gap_mm
    picture = curves_picture(
        f"{held.spec.name}: force of one loop at a gap of {gap_mm:g} mm, {held.axis}",
        "temperature of the wire in °C",
        [Panel("force in N", lines)],
    )
    table = table_csv(columns).encode()
    return {"curves/temperature.csv": table, "pictures/temperature.png": picture}


def _force(held: Vice, point: ForcePoint) -> float | None:
    return None if point.found is None else point.found.force * held.force_unit_N


def _forces(held: Vice, points: Sequence[ForcePoint]) -> Values:
    forces = [_force(held, point) for point in points]
    return np.array([np.nan if force is None else force for force in forces])
