"""Wire that is looked up in cells is that which lies there: held against plain geometry."""

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from patterns.edge_clearance import edge_clearance_mm
from patterns.laid_wire import all_laid, laid_wire
from patterns.path import Arc, Line, WirePath
from patterns.piece_cells import PieceCells
from patterns.wire_index import WireIndex

QUICK = settings(deadline=None, max_examples=60)
CHORD_MM = 1e-4
PLACE = st.floats(-40, 40).map(lambda x: round(x, 3))
PLACES = st.lists(st.tuples(PLACE, PLACE), min_size=1, max_size=12).map(np.array)
LINES = st.builds(Line, PLACE, PLACE, PLACE, PLACE).filter(lambda one: one.length_mm > 0.01)
SWEEPS = st.one_of(
    st.sampled_from([0.0, -0.0, 2 * np.pi, -2 * np.pi, np.pi, -np.pi]), st.floats(-6.28, 6.28)
)
ARCS = st.builds(Arc, PLACE, PLACE, st.floats(0.2, 30), st.floats(-7, 7), SWEEPS)
PIECES = st.lists(st.one_of(LINES, ARCS), min_size=1, max_size=8).map(tuple)


def drawn(piece):
    points = WirePath((piece,)).polyline(CHORD_MM)
    return shapely.LineString(points) if piece.length_mm > 0 else shapely.Point(points[0])


def distances(points, pieces):
    """Distance (points, pieces), by chords."""
    lines = np.array([drawn(piece) for piece in pieces])
    return shapely.distance(shapely.points(points)[:, None], lines)


@QUICK
@given(PIECES, PLACES)
def test_the_distance_from_a_piece_is_that_from_its_chords(pieces, points):
    cells = PieceCells(pieces)
    point, piece = (one.ravel() for one in np.indices((len(points), len(pieces))))
    found = cells.distance_mm(points[point], piece).reshape(len(points), -1)
    assert found == pytest.approx(distances(points, pieces), abs=2 * CHORD_MM)
    for own, ends in zip(pieces, cells.ends_mm, strict=True):
        assert ends == pytest.approx(own.at(np.array([0.0, own.length_mm]))[0], abs=1e-9)


@QUICK
@given(PIECES, PLACES, st.sampled_from([0.3, 1.0, 1.7, 4.0, 9.0]))
def test_no_piece_within_reach_is_missed_and_none_far_off_is_named(pieces, points, reach_mm):
    cells = PieceCells(pieces)
    point, piece = cells.near(points, reach_mm)
    pairs = list(zip(point.tolist(), piece.tolist(), strict=True))
    assert point.tolist() == sorted(point.tolist())
    assert len(set(pairs)) == len(pairs)
    away = distances(points, pieces)
    near = {tuple(pair) for pair in np.argwhere(away <= reach_mm - 2 * CHORD_MM).tolist()}
    assert near <= set(pairs)
    step = 2 * max(2 * reach_mm, 1.0)  # tables are for reaches that are powers of two
    assert all(away[pair] <= 5 * step for pair in pairs)


@QUICK
@given(PIECES, PLACES, st.sampled_from([0.5, 3.0, 20.0]))
def test_the_nearest_wire_of_several_thicknesses_is_found(pieces, points, reach_mm):
    thick = [0.2 + 0.3 * (k % 3) for k in range(len(pieces))]
    parts = [
        laid_wire(WirePath((piece,)), wire_diameter_mm=own)
        for piece, own in zip(pieces, thick, strict=True)
    ]
    laid = all_laid(parts).like(0.5)
    expected = (distances(points, pieces) - (np.array(thick) - 0.5) / 2).min(axis=1)
    found = laid.distance_mm(points, reach_mm)
    sure = np.abs(expected - reach_mm) > 2 * CHORD_MM
    expected[expected > reach_mm] = np.inf
    assert found[sure] == pytest.approx(expected[sure], abs=2 * CHORD_MM)


@QUICK
@given(PIECES, PLACES, PLACES)
def test_an_edge_is_as_far_from_wire_as_from_its_chords(pieces, starts, ends):
    assume(all(piece.length_mm > 0 for piece in pieces))
    count = min(len(starts), len(ends))
    starts, ends = starts[:count], ends[:count] + 0.05
    lines = [drawn(piece) for piece in pieces]
    edges = np.array([shapely.LineString(pair) for pair in zip(starts, ends, strict=True)])
    expected = shapely.distance(edges, shapely.union_all(lines))
    assume(np.all(np.hypot(*(ends - starts).T) > 0.01))
    reach_mm = 6.0
    found = edge_clearance_mm(starts, ends, WireIndex(WirePath(pieces)), reach_mm)
    free = (expected > 2 * CHORD_MM) & (expected <= reach_mm)
    assert found[free] == pytest.approx(expected[free], abs=2 * CHORD_MM)
    assert np.all(found[expected > reach_mm] >= reach_mm - 2 * CHORD_MM)


@QUICK
@given(PIECES, PLACES, st.floats(0.5, 30), st.data())
def test_places_on_wire_leave_out_what_they_are_told_to(pieces, points, reach_mm, data):
    """Of a wire in pieces apart; places on it are those that its pieces give."""
    assume(all(piece.length_mm > 0 for piece in pieces))
    wire = WireIndex(WirePath(pieces))
    among = np.array(data.draw(st.lists(st.booleans(), min_size=len(pieces), max_size=len(pieces))))
    away = distances(points, pieces)
    point, piece = wire.within(points, reach_mm, among=among)
    named = np.zeros(away.shape, dtype=bool)
    named[point, piece] = True
    sure = np.abs(away - reach_mm) > 2 * CHORD_MM
    assert np.array_equal(named[sure], ((away <= reach_mm) & among)[sure])
    nearest = wire.nearest(points, reach_mm, among=among)
    least = np.where(among, away, np.inf).min(axis=1)
    near = least <= reach_mm - 2 * CHORD_MM
    assert nearest.distance_mm[near] == pytest.approx(least[near], abs=2 * CHORD_MM)
    assert np.all(np.isinf(nearest.distance_mm[least > reach_mm + 2 * CHORD_MM]))
    foot = wire.at(nearest.station_mm[near])
    lengths = np.hypot(*(points[near] - foot).T)
    starts = np.cumsum([0.0, *(own.length_mm for own in pieces)])
    inside = np.abs(nearest.station_mm[near, None] - starts).min(axis=1, initial=np.inf) > 1e-9
    assert lengths[inside] == pytest.approx(nearest.distance_mm[near][inside], abs=1e-6)


@pytest.mark.parametrize("reach_mm", [0.9, 1.99, 3.99])
def test_no_place_beside_a_slanting_wire_is_missed(reach_mm):
    for shift in np.linspace(0.0, 4 * reach_mm, 81):
        wire = Line(shift, 0.0, shift + 12.0, 12.0)
        along = np.arange(0.0, wire.length_mm, 0.1)
        foot, tangent = wire.at(along)
        for side in (-0.999, 0.999):
            normal = side * np.stack([-tangent[:, 1], tangent[:, 0]], axis=1)
            point, _ = PieceCells((wire,)).near(foot + reach_mm * normal, reach_mm)
            assert point.tolist() == list(range(len(along)))


WAYS = (Line(0.0, 0.0, 10.0, 0.0), Arc(5.0, 20.0, 10.0, 0.5, 2 * np.pi))


@pytest.mark.parametrize(
    ("edge", "expected"),
    [
        ([(5.0, 8.0), (5.0, 2.0)], 2.0),
        ([(11.0, -6.0), (16.0, 4.0)], np.sqrt(12.8)),
        ([(-1.0, -6.0), (-6.0, 4.0)], np.sqrt(12.8)),
        ([(13.0, -5.0), (13.0, 5.0)], 3.0),
        ([(12.9, 0.0), (30.0, 0.0)], 2.9),
        ([(6.0, 13.0), (5.0, 11.0)], 1.0),
        ([(-9.0, 12.0), (9.0, 8.0)], np.nan),
    ],
)
def test_an_edge_is_nearest_in_an_end_or_a_foot(edge, expected):
    path = WirePath(WAYS)
    if np.isnan(expected):  # of the arc's centre
        line = shapely.LineString(edge)
        expected = float(np.min([line.distance(drawn(one)) for one in WAYS]))
    for ends in (edge, edge[::-1]):
        start, end = (np.array([one]) for one in ends)
        found = edge_clearance_mm(start, end, WireIndex(path), 4.0)
        assert found == pytest.approx([expected], abs=2 * CHORD_MM)


def test_wire_beyond_the_end_of_a_long_edge_is_found():
    wire = WireIndex(WirePath((Line(12.9, -1.0, 12.9, 1.0),)))
    start, end = np.zeros((1, 2)), np.array([[10.0, 0.0]])
    assert edge_clearance_mm(start, end, wire, 3.0) == pytest.approx([2.9])


def test_wire_in_line_with_a_point_is_out_of_reach_beyond_its_end():
    wire = WireIndex(WirePath((Line(0.0, 0.0, 10.0, 0.0),)))
    points = np.array([[13.5, 0.0], [12.5, 0.0]])
    assert wire.nearest(points, 3.0).distance_mm.tolist() == [np.inf, 2.5]


def test_much_thicker_wire_is_found_from_its_surface():
    thin, thick = (
        laid_wire(WirePath((Line(0.0, y, 10.0, y),)), wire_diameter_mm=own)
        for y, own in ((-20.0, 0.4), (0.0, 6.0))
    )
    place = np.array([[5.0, 4.0]])
    assert all_laid([thin, thick]).like(0.0).distance_mm(place, 1.5) == pytest.approx([1.0])
    assert all_laid([thin, thick]).distance_mm(place, 4.5) == pytest.approx([4.0])
    assert all_laid([thick, thin]).distance_mm(place, 1.5) == pytest.approx([1.2])
