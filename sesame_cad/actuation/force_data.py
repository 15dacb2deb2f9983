"""Forces between plates as plain data: what ``sesame-cad force --json`` prints."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees
from typing import Any

from sesame_cad.actuation.force import ForcePoint, TemperaturePoint, Vice
from sesame_cad.omitted_data import omitted_data

Data = dict[str, Any]


def subject_data(held: Vice) -> Data:
    """Keys of the loop and of how it is held."""
    spec = held.spec
    return {
        "name": spec.name,
        "axis": str(held.axis),
        "gap_measured_to": str(held.measured_to),
        "strain": spec.fabric.prestrain,
        "poisson": spec.fabric.poisson,
        "reading": spec.model.reading,
        "loop_diameter_mm": 2 * held.radius_mm,
        "wire_diameter_mm": spec.wire.diameter_mm,
    }


def point_data(held: Vice, point: ForcePoint) -> Data:
    """Keys of one state; null for what a state without a shape to rely on does not have."""
    scene = held.cell.scene(point.fraction)
    ratio = held.cell.modulus_ratio
    found = point.found
    head: Data = {
        "force_N": None,
        "gap_mm": point.gap_mm,
        "austenite_fraction": point.fraction,
        "modulus_GPa": held.spec.wire.modulus_cold_GPa * (1 + point.fraction * (ratio - 1)),
        "beta": scene.beta,
        "converged": found is not None,
        "status": point.status,
    }
    if found is None:
        return head
    radius_mm, unit_N = held.radius_mm, held.force_unit_N  # noqa: N806
    return head | {
        "force_N": found.force * unit_N,
        "contacts": [
            {
                "on": "wire" if one.radius == 1 else "fabric",
                "radius_mm": one.radius * radius_mm,
                "angle_deg": degrees(one.angle_rad),
                "plate": "upper" if one.upper else "lower",
                "force_N": one.force * unit_N,
            }
            for one in found.contacts
        ],
        "height_mm": found.height * radius_mm,
        "widths_mm": [width * radius_mm for width in found.widths],
        "energy_mJ": found.energy * held.materials.energy_unit_J * 1e3,
        "upright": found.upright,
        "gradient_norm": found.gradient_norm,
        "lowest_eigenvalue": found.lowest_eigenvalue,
        "tilt_eigenvalue": found.tilt_eigenvalue,
        "change": found.change,
        "unknowns": found.unknowns,
        "steps": found.steps,
        "omitted_terms": omitted_data(point.omitted),
    }


def curve_data(held: Vice, cold: Sequence[ForcePoint], hot: Sequence[ForcePoint]) -> list[Data]:
    """A gap each, cold and hot."""
    return [
        {"gap_mm": a.gap_mm, "cold": point_data(held, a), "hot": point_data(held, b)}
        for a, b in zip(cold, hot, strict=True)
    ]


def temperature_data(held: Vice, points: Sequence[TemperaturePoint]) -> list[Data]:
    """A temperature each, on the way up and on the way down."""
    return [
        {"temperature_C": one.temperature_C, "way": one.way} | point_data(held, one.point)
        for one in points
    ]
