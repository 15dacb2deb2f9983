"""Layouts of every kind, from the specification to the folder and its check."""

import json
from itertools import product
from math import cos, pi, sin
from pathlib import Path

import pytest

from patterns.loop import Loop
from sesame_cad.errors import InputError
from sesame_cad.files.stl import read_stl
from sesame_cad.pipeline import pattern
from sesame_cad.specification import specification_from
from sesame_cad.specification.prediction import predicted_shape
from sesame_cad.verification import verify

EXAMPLES = Path(__file__).parents[2] / "examples"
WIRE = {"diameter_mm": 0.4}
WIDE = {"hoop_width_mm": 900, "hoop_height_mm": 900}
CHAIN = [
    {"x_mm": 100, "y_mm": 3, "diameter_mm": 50},
    {"x_mm": 140, "y_mm": 3, "diameter_mm": 30},
    {"x_mm": 165, "y_mm": 3, "diameter_mm": 20},
]


def layout_of(kind, **keys):
    size = {"rows": 3, "columns": 3, "loop_diameter_mm": 40}
    if kind == "row":
        size.pop("rows")
    if kind == "circles":
        size = {"circles": CHAIN}
    shape = "cell" if kind in {"grid", "row"} else "none"
    return {"kind": kind, "shape": shape, **size, **keys}


def specification(kind, **keys):
    data = {"wire": WIRE, "layout": layout_of(kind, **keys), "machine": WIDE}
    return specification_from({**data, "outline": {"margin_mm": 1.3}}, "x")


def faults(layout, **sections):
    with pytest.raises(InputError) as caught:
        pattern(specification_from({"wire": WIRE, "layout": layout, **sections}, "x"))
    return caught.value.faults


@pytest.mark.parametrize(
    ("kind", "side"),
    [
        *product(["grid", "brick", "hexagonal", "row", "circles"], ["corner"]),
        *product(["brick", "circles"], ["left", "right", "top", "bottom"]),
    ],
)
def test_every_kind_makes_a_pattern_that_breaks_no_rule(kind, side):
    spec = specification(kind, terminals=side)
    laid = pattern(spec)
    assert len(laid.circuit.layout.loops) == {"hexagonal": 8, "row": 3, "circles": 3}.get(kind, 9)


def test_the_hoop_that_is_needed_holds_the_plan():
    data = {"wire": WIRE, "layout": layout_of("brick"), "outline": {"margin_mm": 1.3}}
    (fault,) = faults(data["layout"], outline=data["outline"], machine={"hoop_width_mm": 30})
    needed = float(fault.partition("at least ")[2].split()[0])
    close = {"hoop_width_mm": needed + 0.1}
    pattern(specification_from({**data, "machine": close}, "x"))


def test_rows_of_a_single_kind_need_no_rows():
    assert len(specification("row").layout.loops()) == 3


def test_a_specification_of_circles_is_written_and_read_back():
    import tomllib  # noqa: PLC0415

    for spec in (specification("circles"), specification("grid", missing=[[2, 2]])):
        assert specification_from(tomllib.loads(spec.to_toml()), "y") == spec


@pytest.mark.parametrize("kind", ["brick", "hexagonal", "circles"])
def test_the_shape_of_what_does_not_tile_is_refused(kind):
    (fault,) = faults(layout_of(kind, shape="cell"), machine=WIDE)
    assert "coupled array solve" in fault


def test_circles_that_nearly_touch_are_named_with_their_gap():
    near = [CHAIN[0], {**CHAIN[1], "x_mm": 140.2}]
    (fault,) = faults(layout_of("circles", circles=near))
    assert "0.2000 mm apart" in fault


def test_circles_that_overlap_are_named():
    (fault,) = faults(layout_of("circles", circles=[CHAIN[0], {**CHAIN[1], "x_mm": 139}]))
    assert "loops 0 and 1 overlap" in fault


def test_two_circles_in_one_place_overlap():
    (fault,) = faults(layout_of("circles", circles=[CHAIN[0], CHAIN[0]]))
    assert "loops 0 and 1 overlap" in fault


@pytest.mark.parametrize("bad", [{"x_mm": 1, "y_mm": 1}, {**CHAIN[0], "z_mm": 1}])
def test_a_circle_with_a_key_too_few_or_too_many(bad):
    (fault,) = faults(layout_of("circles", circles=[bad]))
    assert "layout.circles = [" in fault
    assert "must be a list, each item with three numbers" in fault


def test_tails_without_room_are_refused():
    ring = [{"x_mm": 300 * cos(k * pi / 30), "y_mm": 300 * sin(k * pi / 30)} for k in range(60)]
    circles = [{**place, "diameter_mm": 600 * sin(pi / 60)} for place in ring]
    (fault,) = faults(layout_of("circles", circles=circles, terminals="top"), machine=WIDE)
    assert "tails cannot leave at the top" in fault


def test_an_array_in_two_pieces_is_refused():
    (fault,) = faults(layout_of("grid", missing=[[r, 2] for r in (1, 2, 3)]), machine=WIDE)
    assert "is 40.000 mm apart" in fault


def test_nothing_left_is_refused():
    (fault,) = faults(layout_of("row", columns=1, missing=[[1, 1]]))
    assert "leaves no loop" in fault


def test_a_bend_too_tight_in_one_circle_is_found():
    small = {"x_mm": 127, "y_mm": 3, "diameter_mm": 4}
    (fault,) = faults(layout_of("circles", circles=[CHAIN[0], small]))
    assert fault.startswith("specification: layout.circles = 4: must be at least 20")


def test_a_cut_line_through_stitches_is_refused_before_anything_is_written():
    found = faults(layout_of("grid"), outline={"margin_mm": 0.5}, machine=WIDE)
    assert any("cut-stitches" in fault for fault in found)


def _toml(layout):
    return specification_from(
        {"wire": WIRE, "layout": layout, "machine": WIDE, "outline": {"margin_mm": 1.3}}, "array"
    ).to_toml()


def test_a_design_without_a_shape_has_stitches_and_cuts_only(run_design, tmp_path):
    (tmp_path / "array.toml").write_text(_toml(layout_of("brick")))
    data = run_design([str(tmp_path / "array.toml"), "-o", str(tmp_path / "out")])
    assert data["cold"] is data["hot"] is data["threshold"] is None
    assert data["circuit"]["stages"] == 3
    assert data["circuit"]["covered_contacts"] == data["circuit"]["contacts"] == 16
    kinds = [(block["kind"], block["stage"]) for block in data["stitch"]["blocks"]]
    assert kinds[1:] == [("wire", 1), ("cover", 2), ("wire", 2), ("cover", 3), ("wire", 3)]
    assert "Stage 3 of 3" in data["stitch"]["blocks"][-1]["instruction"]
    assert set(data["files"]) == {
        "plan/array.svg",
        "stitch/array.blocks.csv",
        "worksheet/array.pdf",
        "stitch/array.dst",
        "cut/array.svg",
        "cut/array.dxf",
        "pictures/plan.png",
        "report.html",
    }
    assert verify(tmp_path / "out") == ()


def test_a_grid_with_a_missing_loop_has_a_shape(run_design, tmp_path):
    (tmp_path / "array.toml").write_text(_toml(layout_of("grid", missing=[[2, 2]])))
    data = run_design([str(tmp_path / "array.toml"), "-o", str(tmp_path / "out")])
    assert data["circuit"]["loops"] == 8
    assert data["cold"]["array_energy_mJ"] == pytest.approx(8 * data["cold"]["energy_mJ"])
    assert verify(tmp_path / "out") == ()
    for name in ("flat", "cold", "hot"):
        solid = read_stl((tmp_path / "out" / "shape" / f"{name}.stl").read_bytes())
        assert solid.bounds.sum(axis=0)[:2] == pytest.approx([0, 0], abs=0.01)


def test_the_summary_of_a_design_without_a_shape(run_command, tmp_path):
    (tmp_path / "array.toml").write_text(_toml(layout_of("circles")))
    arguments = ["design", str(tmp_path / "array.toml"), "-o", str(tmp_path / "out")]
    code, out, _ = run_command(arguments)
    assert code == 0
    assert "no shape is predicted" in out
    assert json.loads((tmp_path / "out" / "design.json").read_text())["beta"] is None


@pytest.mark.parametrize("angle", [0, 90])
@pytest.mark.parametrize("kind", ["grid", "brick", "hexagonal", "row"])
def test_ellipses_on_every_lattice_make_a_pattern_that_breaks_no_rule(kind, angle):
    oval = {"axis_ratio": 1.5, "axis_angle_deg": angle, "loop_diameter_mm": 50, "shape": "none"}
    laid = pattern(specification(kind, **oval))
    loop = laid.circuit.layout.loops[0]
    width, height = loop.box_mm()[2] - loop.box_mm()[0], loop.box_mm()[3] - loop.box_mm()[1]
    assert width / height == pytest.approx(1.5 if angle == 0 else 1 / 1.5)


def test_a_row_of_different_loops_makes_a_pattern_that_breaks_no_rule():
    row = {"kind": "row", "diameters_mm": [25, 30, 25], "shape": "none", "axis_ratio": 1}
    data = {"wire": {"diameter_mm": 0.3}, "layout": row, "machine": WIDE}
    laid = pattern(specification_from({**data, "outline": {"margin_mm": 1.3}}, "x"))
    assert [loop.diameter_mm for loop in laid.circuit.layout.loops] == [25, 30, 25]
    assert len(laid.circuit.layout.contacts) == 2


def test_ellipses_in_any_direction_make_a_pattern_that_breaks_no_rule():
    long_mm = Loop(0, 0, 70, 1.5).semi_axes_mm[0]
    ovals = [
        {"x_mm": place, "y_mm": 0, "diameter_mm": 70, "axis_ratio": 1.5}
        for place in (0, round(2 * long_mm, 4))
    ]
    turned = [
        {"x_mm": 0, "y_mm": one["x_mm"], "diameter_mm": 70, "axis_ratio": 1.5, "axis_angle_deg": 90}
        for one in ovals
    ]
    for circles in (ovals, turned):
        laid = pattern(specification("circles", circles=circles))
        assert len(laid.circuit.layout.contacts) == 1


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"kind": "grid", "rows": 2, "axis_ratio": 1.5}, "ellipse is diagonal"),
        ({"kind": "row", "axis_ratio": 2}, "ellipse is diagonal"),
        ({"kind": "row", "diameters_mm": [70, 80]}, "different diameters"),
    ],
)
def test_one_cell_is_not_the_shape_of_ellipses_or_unequal_loops(keys, said):
    size = {} if "diameters_mm" in keys else {"columns": 2, "loop_diameter_mm": 80}
    layout = {**size, **keys}
    (fault,) = faults({**layout, "shape": "cell"}, machine=WIDE)
    assert 'layout.shape = "cell": cannot be had' in fault
    assert said in fault
    spec = specification_from({"wire": WIRE, "layout": layout, "machine": WIDE}, "x")
    assert predicted_shape(spec.layout, spec.model, spec.wiring, spec.wire) == "coupled"


@pytest.mark.parametrize(
    ("layout", "said"),
    [
        ({"diameters_mm": [30, 40]}, "layout.diameters_mm: must be left out for layout.kind"),
        ({"kind": "row", "diameters_mm": [30, 40]}, "left out when layout.diameters_mm is given"),
        ({"kind": "circles", "axis_ratio": 2}, "give it in each of layout.circles"),
        ({"axis_angle_deg": 90}, "must be left out when layout.axis_ratio is 1"),
        ({"axis_ratio": 2, "axis_angle_deg": 45}, "axis_angle_deg = 45"),
        ({"axis_ratio": 0.5}, "axis_ratio = 0.5: must be from 1 to 5"),
        ({"kind": "row", "diameters_mm": [30, 0]}, "layout.diameters_mm"),
        ({"kind": "row", "diameters_mm": [30, "wide"]}, "layout.diameters_mm"),
        ({"axis_ratio": 3}, "a smaller loop with an axis ratio of 3 bends wire of 0.4 mm"),
    ],
)
def test_what_does_not_go_with_ellipses_and_rows_is_said(layout, said):
    found = faults({**layout_of(layout.get("kind", "grid")), "shape": "none", **layout})
    assert any(said in fault for fault in found), found
    assert all(len(fault.splitlines()) == 1 for fault in found)


def test_an_ellipse_as_tight_as_the_wire_allows_is_sewn():
    given = {"axis_ratio": 2, "shape": "none", "loop_diameter_mm": 40, "columns": 2}
    (fault,) = faults({"kind": "row", **given}, machine=WIDE)
    least = float(fault.partition("at least ")[2].split(":")[0])
    row = {**given, "loop_diameter_mm": least * (1 + 1e-6)}
    laid = pattern(specification("row", **row))
    assert laid.circuit.smallest_radius_mm == pytest.approx(25 * WIRE["diameter_mm"], rel=1e-5)


def test_a_whole_design_of_ellipses_is_as_it_should_be(run_design, tmp_path):
    data = run_design([str(EXAMPLES / "ellipses.toml"), "-o", str(tmp_path / "out")])
    circuit = data["circuit"]
    assert circuit["covered_contacts"] == circuit["contacts"] == 33
    bend = circuit["smallest_bend_radius_mm"]
    assert circuit["largest_curvature_per_mm"] == pytest.approx(1 / bend)
    assert verify(tmp_path / "out") == ()


def test_the_needed_hoop_holds_ellipses():
    given = {"axis_ratio": 2, "shape": "none", "loop_diameter_mm": 70}
    (fault,) = faults(layout_of("row", **given), machine={"hoop_width_mm": 30})
    needed = float(fault.partition("at least ")[2].split()[0])
    data = {"wire": WIRE, "layout": layout_of("row", **given), "outline": {"margin_mm": 2.0}}
    pattern(specification_from({**data, "machine": {"hoop_width_mm": needed + 0.1}}, "x"))
