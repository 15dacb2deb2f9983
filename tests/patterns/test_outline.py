import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import Polygon, box
from shapely.geometry.polygon import orient

from patterns.circuit import Circuit
from patterns.edge_clearance import edge_clearance_mm
from patterns.errors import PatternError
from patterns.machine import Machine
from patterns.outline import Outline, _shrunk, cut_outline
from patterns.path import Line, WirePath
from patterns.plan import Block, BlockKind, Run, StitchPlan
from patterns.rules import check_outline
from patterns.stitch_plan import stitch_plan
from patterns.stitching import Stitching
from patterns.tangent_switch import grid_circuit
from patterns.wire_index import WireIndex

WIRE_MM, MARGIN_MM, CORNER_MM = 0.3, 1.5, 1.0


@cache
def circuit_of(rows: int, columns: int, loop_mm: float = 25.0) -> Circuit:
    return grid_circuit(rows, columns, loop_mm, 40.0)


@cache
def made() -> tuple[Outline, Circuit]:
    circuit = circuit_of(2, 3)
    return cut_outline(circuit, WIRE_MM, MARGIN_MM, CORNER_MM), circuit


def rules(outline: Outline, plan: StitchPlan | None = None) -> list[str]:
    faults = check_outline(outline, made()[1], WIRE_MM, MARGIN_MM, plan)
    return [fault.rule for fault in faults]


def along(outline: Outline) -> np.ndarray:
    start, end = outline.edges_mm()
    return np.concatenate([start + share * (end - start) for share in np.linspace(0, 1, 9)])


def to_wire_mm(points: np.ndarray, circuit: Circuit) -> np.ndarray:
    halves = [WireIndex(half) for half in circuit.stages]
    return np.min([half.nearest(points, 50.0).distance_mm for half in halves], axis=0)


@pytest.mark.parametrize(("rows", "columns"), [(1, 1), (1, 3), (2, 2), (3, 4)])
@pytest.mark.parametrize("corner_mm", [0.0, 1.0, 2.5])
def test_the_margin_is_kept_and_every_face_is_opened(
    rows: int, columns: int, corner_mm: float
) -> None:
    circuit = circuit_of(rows, columns)
    outline = cut_outline(circuit, WIRE_MM, MARGIN_MM, corner_mm)
    distance = to_wire_mm(along(outline), circuit)
    assert distance.min() >= WIRE_MM / 2 + MARGIN_MM
    assert distance.min() <= WIRE_MM / 2 + MARGIN_MM + 0.01
    assert len(outline.openings) == (rows - 1) * (columns - 1)
    assert check_outline(outline, circuit, WIRE_MM, MARGIN_MM, None) == ()


@settings(deadline=None, max_examples=15)
@given(st.floats(15, 60), st.floats(0.1, 0.6), st.floats(0.2, 2.0))
def test_chords_stay_within_the_tolerance(loop_mm: float, wire_mm: float, margin_mm: float) -> None:
    circuit = grid_circuit(2, 2, loop_mm, 30.0)
    outline = cut_outline(circuit, wire_mm, margin_mm, 0.0)
    excess = to_wire_mm(along(outline), circuit) - wire_mm / 2 - margin_mm
    assert excess.min() >= 0
    assert excess.max() <= 0.01


@pytest.mark.parametrize("corner_mm", [0.5, 1.5])
def test_inner_corners_are_round(corner_mm: float) -> None:
    outline = cut_outline(circuit_of(2, 2), WIRE_MM, MARGIN_MM, corner_mm)
    opening = Polygon(outline.openings[0])
    sharp = Polygon(cut_outline(circuit_of(2, 2), WIRE_MM, MARGIN_MM, 0.0).openings[0])
    assert opening.within(sharp.buffer(0.01))
    rolled = opening.buffer(-0.98 * corner_mm).buffer(0.98 * corner_mm)
    assert opening.difference(rolled.buffer(0.02)).is_empty
    assert not sharp.difference(rolled.buffer(0.02)).is_empty


def test_the_outside_is_counter_clockwise_and_openings_are_clockwise() -> None:
    outline, _ = made()
    assert Polygon(outline.outside).exterior.is_ccw
    assert not any(Polygon(ring).exterior.is_ccw for ring in outline.openings)


@pytest.mark.parametrize("corner_mm", [0.0, 1.0, 2.0])
def test_the_largest_margin_that_is_named_leaves_an_opening(corner_mm: float) -> None:
    circuit = circuit_of(2, 2)
    with pytest.raises(PatternError, match="largest margin") as caught:
        cut_outline(circuit, WIRE_MM, 5.5, corner_mm)
    (named,) = re.findall(r"leaves it is ([\d.]+) mm", str(caught.value))
    assert len(cut_outline(circuit, WIRE_MM, float(named), corner_mm).openings) == 1
    with pytest.raises(PatternError, match="vanishes"):
        cut_outline(circuit, WIRE_MM, float(named) + 0.03, corner_mm)


def test_a_corner_radius_that_fills_every_opening_is_refused() -> None:
    with pytest.raises(PatternError, match=r"corner radius must be less than 5\.0"):
        cut_outline(circuit_of(2, 2), WIRE_MM, 0.5, 6.0)


@pytest.mark.parametrize("quantities", [(0.0, 1.0, 1.0), (0.3, 0.0, 1.0), (0.3, 1.0, -1.0)])
def test_impossible_quantities_are_refused(quantities: tuple[float, float, float]) -> None:
    with pytest.raises(PatternError, match="positive"):
        cut_outline(circuit_of(1, 1), *quantities)


def test_fabric_that_falls_apart_is_refused() -> None:
    circuit = circuit_of(1, 1)
    far = WirePath((Line(300.0, 300.0, 330.0, 300.0),))
    with pytest.raises(PatternError, match="falls apart"):
        cut_outline(
            replace(circuit, stages=(circuit.stages[0], far)), WIRE_MM, MARGIN_MM, CORNER_MM
        )


def test_an_edge_is_nearest_to_an_arc_between_its_ends() -> None:
    wire = WireIndex(circuit_of(1, 1).stages[0])
    start, end = np.array([[-14.0, -30.0]]), np.array([[-14.0, 30.0]])
    places = start + np.linspace(0, 1, 60001)[:, None] * (end - start)
    expected = wire.nearest(places, 50.0).distance_mm.min()
    assert edge_clearance_mm(start, end, wire, 5.0) == pytest.approx([expected], abs=1e-6)
    assert edge_clearance_mm(start - 500, end - 500, wire, 5.0) == [np.inf]


def test_a_bad_ring_is_found() -> None:
    outline, _ = made()
    ring = outline.outside
    assert rules(replace(outline, outside=np.vstack([ring, ring[:1]]))) == ["cut-ring"]
    crossed = ring.copy()
    crossed[[10, 60]] = crossed[[60, 10]]
    assert rules(replace(outline, outside=crossed)) == ["cut-ring"]
    assert rules(replace(outline, outside=ring[::-1])) == ["cut-ring"]
    assert rules(replace(outline, outside=ring[:2])) == ["cut-ring"]
    assert rules(replace(outline, outside=np.where(ring > 0, np.nan, ring))) == ["cut-ring"]


def test_rings_that_overlap_are_found() -> None:
    outline, _ = made()
    first = outline.openings[0]
    twice = replace(outline, openings=(*outline.openings, first))
    assert rules(twice) == ["cut-overlap"]
    beyond = replace(outline, openings=(first + 500.0,))
    assert rules(beyond) == ["cut-overlap"]


def test_a_cut_near_or_through_the_wire_is_found() -> None:
    outline, circuit = made()
    first, *others = outline.openings
    moved = replace(outline, openings=(first + 0.02, *others))
    assert set(rules(moved)) == {"cut-margin"}
    through = replace(outline, openings=(first + 5.0, *others))
    faults = check_outline(through, circuit, WIRE_MM, MARGIN_MM, None)
    assert any("goes through" in fault.message for fault in faults)


def test_a_cut_across_a_tail_is_found_far_from_its_corners() -> None:
    outline, circuit = made()
    tail = circuit.stages[0].pieces[0]
    assert isinstance(tail, Line)
    end, start = np.array([tail.x0_mm, tail.y0_mm]), np.array([tail.x1_mm, tail.y1_mm])
    middle, ahead = (start + end) / 2, (start - end) / np.hypot(*(start - end))
    across = np.array([-ahead[1], ahead[0]])
    knife = Polygon([middle - 9 * across, middle + 9 * across, middle - 500 * ahead])
    short = orient(Polygon(outline.outside).difference(knife))
    faults = check_outline(
        replace(outline, outside=np.array(short.exterior.coords)[:-1]),
        circuit,
        WIRE_MM,
        MARGIN_MM,
        None,
    )
    assert any("goes through" in fault.message for fault in faults)


def test_stitches_must_lie_on_fabric_away_from_cuts() -> None:
    outline, circuit = made()
    machine = Machine(600, 600, 0.75)
    plan = stitch_plan(circuit, Stitching(), machine, WIRE_MM, ())
    assert rules(outline, plan) == []
    inside = Polygon(outline.openings[0]).representative_point()
    near = outline.openings[0][0]
    for x, y, words in ((inside.x, inside.y, "cut away"), (*near, "cut")):
        needles = np.array([[round(10 * x), round(10 * y)]])
        stray = Block(BlockKind.COVER, "", (Run((0, 0), needles),))
        faults = check_outline(outline, circuit, WIRE_MM, MARGIN_MM, StitchPlan((stray,)))
        assert [(f.rule, f.block, f.stitch) for f in faults] == [("cut-stitches", 0, 0)]
        assert words in faults[0].message
        mark = replace(stray, kind=BlockKind.MARKS)
        assert rules(outline, StitchPlan((mark,))) == []


def test_a_stitch_on_fabric_but_near_a_cut_is_found() -> None:
    outline, circuit = made()
    top = outline.outside[np.argmax(outline.outside[:, 1])]
    needles = np.array([[round(10 * top[0]), int(10 * top[1]) - k] for k in range(6)])
    block = Block(BlockKind.COVER, "", (Run((0, 0), needles),))
    faults = check_outline(outline, circuit, WIRE_MM, MARGIN_MM, StitchPlan((block,)))
    depth = top[1] - needles[:, 1] / 10
    assert [fault.stitch for fault in faults] == np.flatnonzero(depth < 0.3).tolist()
    assert all("too near" in fault.message for fault in faults)


C_SHAPE = [(10, 10), (20, 10), (20, 12), (12, 12), (12, 18), (20, 18), (20, 20), (10, 20)]
ROUND_A_BLOCK = [
    *[(10, 14.75), (10, 5), (40, 5), (40, 25), (10, 25), (10, 15.25)],
    *[(14, 15.25), (14, 21), (36, 21), (36, 9), (14, 9), (14, 14.75)],
]
SQUARE = [(30, 12), (36, 12), (36, 18), (30, 18)]


@pytest.mark.parametrize(
    "openings",
    [
        [],
        [SQUARE],
        [SQUARE, C_SHAPE],
        [ROUND_A_BLOCK],  # whose neck goes
        [SQUARE, [(x - 7.5, y) for x, y in SQUARE]],  # run into one another
        [SQUARE, [(x, y - 11.5) for x, y in SQUARE]],  # runs into the outside
        [[*C_SHAPE[:2], (20, 14.5), (12, 14.5), (12, 15.5), (20, 15.5), *C_SHAPE[6:]]],
    ],
)
@pytest.mark.parametrize("by_mm", [0.4, 1.0, 3.2])
def test_fabric_that_is_shrunk_opening_by_opening_is_that_which_is_shrunk_at_once(
    openings: list[list[tuple[float, float]]], by_mm: float
) -> None:
    fabric = Polygon(box(0, 0, 50, 30).exterior, openings)
    at_once = fabric.buffer(-by_mm, quad_segs=256)
    assert _shrunk(fabric, by_mm).symmetric_difference(at_once).area < 2e-3 * by_mm * fabric.length
    assert len(getattr(_shrunk(fabric, by_mm), "interiors", ())) == len(
        getattr(at_once, "interiors", ())
    )
