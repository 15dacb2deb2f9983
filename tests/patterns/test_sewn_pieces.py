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
    distance = PIECES.distance_mm(ends[0], 2.0)
    for place, away in zip(ends[0], distance, strict=True):
        nearest = min(Point(place).distance(own) for own in lines)
        assert np.isclose(away, nearest) if nearest <= 2.0 else away == np.inf
