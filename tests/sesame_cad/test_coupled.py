"""Designs whose loops act on each other, from the specification to the folder and its check."""

import json
import re

import numpy as np
import pytest

from patterns.layout import tangent_layout
from patterns.records import plan_records
from sesame_cad.coupled_state import coupled_scene, solve_coupled
from sesame_cad.design_data import design_data
from sesame_cad.errors import InputError
from sesame_cad.files.stl import read_stl
from sesame_cad.pictures.rendering import View, piece_patch, projected_bounds, render
from sesame_cad.pipeline import Design, design, pattern
from sesame_cad.preview import state_solid
from sesame_cad.sheet_shape import Piece, open_edges
from sesame_cad.sheet_solid import around
from sesame_cad.specification import load_specification, specification_from
from sesame_cad.state import solve_state
from sesame_cad.verification import verify

THREE = {"kind": "brick", "rows": 2, "columns": 2, "missing": [[2, 2]], "loop_diameter_mm": 50}
PAIR = {"kind": "row", "columns": 2, "loop_diameter_mm": 50}
SIZES = {
    "kind": "circles",
    "circles": [
        {"x_mm": 0, "y_mm": 0, "diameter_mm": 50},
        {"x_mm": 45, "y_mm": 0, "diameter_mm": 40},
    ],
}


def data_of(layout, **sections):
    return {
        "wire": {"diameter_mm": 0.5},
        "layout": layout,
        "model": {"refinement": 1},
        "outline": {"margin_mm": 1.3},
        **sections,
    }


def specification(layout, **sections):
    return specification_from(data_of(layout, **sections), "x")


def coupled(spec, name="cold"):
    layout = tangent_layout(spec.layout.loops(), spec.layout.tolerance_mm)
    return solve_coupled(spec, layout, name, lambda _: None)


@pytest.fixture(scope="module")
def three():
    spec = specification(THREE)
    return spec, coupled(spec)


@pytest.mark.parametrize(
    ("layout", "openings"),
    [(THREE, 1), ({**THREE, "between": "kept"}, 0), (SIZES, 0)],
    ids=["cut", "kept", "sizes"],
)
def test_from_the_specification_to_the_check(layout, openings, run_design, tmp_path):
    (tmp_path / "array.toml").write_text(specification(layout).to_toml())
    data = run_design([str(tmp_path / "array.toml"), "-o", str(tmp_path / "out")])
    assert data["outline"]["openings"] == openings
    cold, hot = data["cold"], data["hot"]
    loops = data["circuit"]["loops"]
    assert cold["rung"] == hot["rung"] == "mesh"
    # of the whole array the height may grow: stiffer loops fold about their contacts
    assert cold["loop_heights_mm"]["mean"] > hot["loop_heights_mm"]["mean"]
    assert cold["array_energy_mJ"] == pytest.approx(loops * cold["energy_mJ"])
    heights = cold["loop_heights_mm"]
    assert heights["smallest"] <= heights["mean"] <= heights["largest"]
    assert max(cold["pitch_mm"], hot["pitch_mm"]) < 50
    assert verify(tmp_path / "out") == ()
    for name in ("flat", "cold", "hot"):
        solid = read_stl((tmp_path / "out" / "shape" / f"{name}.stl").read_bytes())
        assert solid.body_count == 1
        assert solid.bounds.sum(axis=0)[:2] == pytest.approx(0, abs=0.02)


def test_the_same_specification_gives_the_same_numbers(three):
    spec, once = three
    again = coupled(spec)
    assert np.array_equal(once.found.positions, again.found.positions)


def test_loops_that_tile_agree_with_their_cell():
    spec = specification({**PAIR, "shape": "coupled"}, model={"refinement": 2})
    together, alone = coupled(spec), solve_state(spec, "cold", spec.wire.modulus_cold_GPa)
    for height in together.loop_heights_mm:
        assert height == pytest.approx(alone.height_mm, rel=together.height_error)
    assert together.height_error < 0.02
    assert together.energy_mJ == pytest.approx(alone.energy_mJ, rel=0.02)
    # a hinge that is all but free still stands a little open
    assert together.pitch_mm == pytest.approx(alone.pitch_mm, rel=0.03)


def test_the_drawn_wires_are_the_solved_ones(three):
    _, state = three
    shape = state.shape
    assert shape.size_mm(0.27)[2] == pytest.approx(state.height_mm + 0.5, abs=0.05)
    lengths = [
        np.linalg.norm(np.roll(chain, -1, axis=0) - chain, axis=1).sum() for chain in shape.wires
    ]
    assert lengths == pytest.approx([np.pi * 50] * 3, rel=2e-3)
    assert len(shape.pieces) == 3
    assert state.flat_shape.size_mm(0.27) == pytest.approx(
        (100.5, 25 * (2 + np.sqrt(3)) + 0.5, 0.5), abs=0.1
    )


def test_kept_fabric_is_a_piece_of_its_own():
    spec = specification({**THREE, "between": "kept"})
    state = coupled(spec)
    assert len(state.shape.pieces) == 4
    solid = state_solid(spec, state)
    assert solid.is_watertight
    assert solid.body_count == 1


def test_a_solid_holds_fabric_and_wire(three):
    spec, state = three
    volume = state_solid(spec, state).volume
    wire = 3 * np.pi * 50 * np.pi * 0.25**2
    fabric = sum(
        np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2 * spec.preview_thickness_mm
        for a, b, c in ((p.points[p.faces[:, k]] for k in range(3)) for p in state.shape.pieces)
    )
    assert volume == pytest.approx(wire + fabric, rel=0.05)


def test_each_circuit_has_its_own_wire():
    circuits = [
        {"name": "a", "cells": [[1, 1]]},
        {"name": "b", "cells": [[1, 2]], "wire_diameter_mm": 0.4, "wire_modulus_hot_GPa": 60.0},
    ]
    spec = specification(PAIR, wiring={"circuits": circuits})
    assert spec.predicted_shape == "coupled"
    layout = tangent_layout(spec.layout.loops())
    cold, hot = (coupled_scene(spec, layout, name).stiffness for name in ("cold", "hot"))
    assert cold[1].beta / cold[0].beta == pytest.approx(0.8**4)
    assert hot[1].beta / hot[0].beta == pytest.approx(0.8**4 * 60 / 75)


@pytest.mark.parametrize(
    ("layout", "model", "said"),
    [
        (THREE, {"fidelity": "compact"}, 'model.fidelity = "compact": must be "mesh" or "auto"'),
        ({**PAIR, "shape": "cell"}, {"fidelity": "mesh"}, 'must be "compact" or "auto"'),
        ({**THREE, "shape": "cell"}, {}, "needs the coupled array solve"),
        ({**THREE, "rows": 9, "columns": 9}, {}, 'must be "none" for 80 loops'),
    ],
)
def test_what_does_not_go_together_is_refused_in_a_line(layout, model, said):
    wide = {"hoop_width_mm": 900, "hoop_height_mm": 900}
    with pytest.raises(InputError) as caught:
        specification(layout, model=model, machine=wide)
    (fault,) = caught.value.faults
    assert said in fault


def test_groups_that_do_not_touch_are_refused():
    apart = [SIZES["circles"][0], {"x_mm": 70, "y_mm": 0, "diameter_mm": 40}]
    spec = specification({"kind": "circles", "circles": apart}, wiring={"split": "groups"})
    with pytest.raises(InputError, match=re.escape('let layout.shape be "none"')):
        design(spec)


def test_kept_fabric_needs_no_room_for_openings():
    """With so wide a margin the opening vanishes, which a cut between the loops refuses."""
    outline = {"margin_mm": 5.0}
    kept = pattern(specification({**THREE, "between": "kept"}, outline=outline)).outline
    assert kept.openings == ()
    with pytest.raises(InputError, match="vanishes"):
        pattern(specification(THREE, outline=outline))


def test_a_chain_is_followed_from_vertex_to_vertex():
    chain = np.array([[0.0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]])
    found = around(chain)(np.array([0, np.pi / 4, np.pi / 2, 2 * np.pi, -np.pi / 4]))
    assert found[:, :2] == pytest.approx(np.array([[0, 0], [1, 0], [2, 0], [0, 0], [0, 1]]))


def test_open_edges_are_those_of_one_face():
    edges = open_edges(np.array([[0, 1, 2], [0, 2, 3]]))
    assert {tuple(edge) for edge in edges.tolist()} == {(0, 1), (1, 2), (2, 3), (3, 0)}


def test_triangles_are_drawn_with_their_area():
    corners = np.array([[-8.0, -8, 0], [8, -8, 0], [8, 8, 0], [-8, 8, 0]])
    square = piece_patch(Piece(corners, np.array([[0, 1, 2], [0, 2, 3]])), np.array([1.0, 0, 0]))
    low, high = projected_bounds([square], np.zeros((1, 2)), View(-90, 90))
    assert (low, high) == (pytest.approx([-8, -8]), pytest.approx([8, 8]))
    image = render(
        [square],
        np.zeros((1, 2)),
        View(-90, 90),
        corner_mm=np.array([-10.0, -10.0]),
        mm_per_pixel=0.1,
        size=(200, 200),
    )
    covered = np.sum(image[..., 1] < 0.9) * 0.01
    assert covered == pytest.approx(256, rel=0.02)


def test_the_hexagonal_example_is_coupled_and_can_be_sewn(run_command, tmp_path):
    from pathlib import Path  # noqa: PLC0415

    example = Path(__file__).parents[2] / "examples" / "hexagonal.toml"
    assert load_specification(example).predicted_shape == "coupled"
    coarse = specification_from(
        load_specification(example, {"model.refinement": 1, "output.pictures": False}).model_dump(
            mode="json"
        ),
        "hexagonal",
    )
    (tmp_path / "hexagonal.toml").write_text(coarse.to_toml())
    code, out, err = run_command(
        ["design", str(tmp_path / "hexagonal.toml"), "-o", str(tmp_path / "out")]
    )
    assert code == 0, err
    assert "all loops solved together" in out
    data = json.loads((tmp_path / "out" / "design.json").read_text())
    assert data["circuit"]["loops"] == 7
    assert data["circuit"]["contacts"] == 12
    assert data["cold"]["height_error"] < 0.1


@pytest.mark.parametrize(("ratio", "told"), [(1.0, True), (1.3, False)])
def test_the_threshold_of_a_circle_is_not_told_of_ellipses(ratio, told):
    states = tuple(solve_state(specification(PAIR), name, 28.0) for name in ("cold", "hot"))
    spec = specification({**PAIR, "axis_ratio": ratio})
    made = Design(spec, pattern(spec), states)
    records = plan_records(made.pattern.plan, spec.patterns_machine())
    assert (design_data(made, records, {})["threshold"] is not None) == told
