import numpy as np
from shapely import LineString, Point

from patterns.cell_table import CellTable
from patterns.sewn_pieces import APART_MM, SewnPieces

RNG = np.random.default_rng(5)
ROWS = [np.cumsum(RNG.normal(0, 0.3, (120, 2)), axis=0) for _ in range(3)]
PIECES = SewnPieces(ROWS)


def line(k: int) -> LineString:
    return LineString([PIECES.start_mm[k], PIECES.end_mm[k]])


def test_a_table_finds_every_thing_around_a_point() -> None:
    places, points = RNG.uniform(-9, 9, (200, 2)), RNG.uniform(-9, 9, (100, 2))
    point, thing = CellTable(places, np.arange(200), 1.3).near(points)
    found = set(zip(point.tolist(), thing.tolist(), strict=True))
    away = np.abs(points[:, None] - places).max(axis=2)
    assert set(map(tuple, np.argwhere(away <= 1.3).tolist())) <= found
    assert len(found) == len(point) < 100 * 200 / 4


def test_pieces_near_one_another_are_all_found() -> None:
    pairs = set(zip(*(own.tolist() for own in PIECES.near_one_another(0.4)), strict=True))
    for later in range(len(PIECES.row)):
        for earlier in range(later):
            along = PIECES.begin_mm[later] - PIECES.middle_mm[earlier]
            apart = PIECES.row[later] != PIECES.row[earlier] or along > APART_MM
            if apart and line(later).distance(line(earlier)) <= 0.4:
                assert (later, earlier) in pairs


def test_crossings_and_distances_are_those_of_the_lines() -> None:
    ends = RNG.uniform(-4, 4, (2, 60, 2))
    stitch, piece, _ = PIECES.crossed(*ends)
    found = set(zip(stitch.tolist(), piece.tolist(), strict=True))
    stitches = [LineString(pair) for pair in ends.transpose(1, 0, 2)]
    lines = [line(k) for k in range(len(PIECES.row))]
    assert found == {
        (i, k) for i, one in enumerate(stitches) for k, own in enumerate(lines) if one.crosses(own)
    }
    for reach_mm, scale in ((2.0, 1.0), (12.0, 6.0)):
        distance = PIECES.distance_mm(scale * ends[0], reach_mm)
        for place, away in zip(scale * ends[0], distance, strict=True):
            nearest = min(Point(place).distance(own) for own in lines)
            assert np.isclose(away, nearest) if nearest <= reach_mm else away == np.inf


def test_each_pair_is_there_once_and_no_stretch_with_itself_or_the_next() -> None:
    later, earlier = PIECES.near_one_another(0.4)
    assert np.all(later > earlier)
    assert len(set(zip(later.tolist(), earlier.tolist(), strict=True))) == len(later)
    stretch = np.floor(PIECES.middle_mm / (APART_MM / 2))
    same = PIECES.row[later] == PIECES.row[earlier]
    assert np.any(same)
    assert np.all(np.abs(stretch[later] - stretch[earlier])[same] > 1)


def test_lengths_count_from_the_start_of_each_row() -> None:
    for k, row in enumerate(ROWS):
        own = PIECES.begin_mm[PIECES.row == k]
        expected = [0.0, *np.cumsum(np.hypot(*np.diff(row, axis=0).T))]
        assert np.allclose([*own, own[-1] + PIECES.size_mm[PIECES.row == k][-1]], expected)


def test_rows_of_one_piece_come_near_one_another() -> None:
    rows = [np.array([[0.0, y], [0.5, y]]) for y in (0.0, 0.1, 9.0)]
    later, earlier = SewnPieces(rows).near_one_another(0.2)
    assert (later.tolist(), earlier.tolist()) == ([1], [0])


def test_long_pieces_are_crossed_and_far_ones_found() -> None:
    rows = [np.array([[-30.0, 0.1 * y], [40.0, 3.0 * y]]) for y in range(-6, 7)]
    pieces, lines = SewnPieces(rows), [LineString(row) for row in rows]
    begin, end = RNG.uniform(-30, 30, (2, 200, 2))
    stitch, piece, share = pieces.crossed(begin, end)
    assert set(zip(stitch.tolist(), piece.tolist(), strict=True)) == {
        (i, k)
        for i, pair in enumerate(zip(begin, end, strict=True))
        for k, own in enumerate(lines)
        if own.crosses(LineString(pair))
    }
    for i, k, at in zip(stitch, piece, share, strict=True):
        place = lines[k].intersection(LineString([begin[i], end[i]]))
        assert place.distance(lines[k].interpolate(at, normalized=True)) < 1e-9
    for reach_mm in (0.5, 5.0, 20.0):
        away = np.array([min(Point(one).distance(own) for own in lines) for one in begin])
        away[away > reach_mm] = np.inf
        assert np.allclose(pieces.distance_mm(begin, reach_mm), away)
