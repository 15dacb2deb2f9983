"""Previews against the solved shape they are made of."""

from pathlib import Path

import numpy as np
import pytest
from trimesh.proximity import closest_point_naive

from sesame_cad.preview import flat_solid, state_solid
from sesame_cad.specification import load_specification
from sesame_cad.state import solve_state

EXAMPLES = Path(__file__).parents[2] / "examples"


def _one_loop(name):
    return load_specification(EXAMPLES / name, {"layout.rows": 1, "layout.columns": 1})


@pytest.mark.parametrize("name", ["large-array.toml", "small-array.toml"])
@pytest.mark.parametrize("temperature", ["cold", "hot"])
def test_the_wires_surface_is_where_the_solved_edge_puts_it(name, temperature):
    spec = _one_loop(name)
    modulus = getattr(spec.wire, f"modulus_{temperature}_GPa")
    state = solve_state(spec, temperature, modulus)
    solid = state_solid(spec, state)
    angle = np.linspace(0, 2 * np.pi, 300, endpoint=False)
    edge = state.surface(np.ones_like(angle), angle)
    distance = closest_point_naive(solid, edge)[1]
    radius = spec.wire.diameter_mm / 2
    assert np.abs(distance - radius).max() < 0.1
    assert solid.extents[2] == pytest.approx(state.height_mm + spec.wire.diameter_mm, abs=1e-3)


def test_the_flat_preview_is_the_array_in_the_hoop():
    spec = load_specification(EXAMPLES / "large-array.toml")
    state = solve_state(spec, "cold", spec.wire.modulus_cold_GPa)
    solid = flat_solid(spec, state)
    assert solid.is_watertight
    assert solid.extents == pytest.approx([200.5, 200.5, 0.5], abs=1e-3)


def test_a_thicker_preview_holds_more():
    thin, thick = (
        load_specification(
            EXAMPLES / "large-array.toml",
            {"layout.rows": 1, "layout.columns": 1, "output.preview_thickness_mm": thickness},
        )
        for thickness in (0.1, 0.4)
    )
    state = solve_state(thin, "cold", thin.wire.modulus_cold_GPa)
    assert state_solid(thick, state).volume > state_solid(thin, state).volume + 300


def test_wires_that_touch_along_an_edge_are_parted():
    """A cell is missing and the wire thin: the union as it comes touches itself in two places."""
    spec = load_specification(
        EXAMPLES / "large-array.toml",
        {
            "layout.rows": 3,
            "layout.columns": 3,
            "layout.loop_diameter_mm": 40,
            "layout.missing": [[2, 2]],
            "wire.diameter_mm": 0.3,
        },
    )
    state = solve_state(spec, "cold", spec.wire.modulus_cold_GPa)
    solid = state_solid(spec, state)
    assert solid.is_watertight
    assert solid.body_count == 1
