from dataclasses import replace
from math import dist, pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import Polygon

from patterns.cut_order import Cut, cuts_in_order, travel_mm
from patterns.cut_piece import CutPiece, Hole
from patterns.errors import PatternError
from patterns.kerf import compensated
from patterns.rounding import Corner, rounded


def ring(x0: float, y0: float, x1: float, y1: float):
    return rounded([Corner(*at, 1.5) for at in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))])


def plate(x_mm: float = 0.0, y_mm: float = 0.0, name: str = "plate") -> CutPiece:
    piece = CutPiece(
        name,
        ring(0, 0, 60, 30),
        (Hole(50, 15, 4), Hole(8, 15, 3)),
        (ring(15, 8, 40, 22).reversed(),),
    )
    return piece.moved(x_mm, y_mm)


@settings(deadline=None, max_examples=25)
@given(st.floats(0.0, 2.5))
def test_the_blade_runs_half_a_kerf_outside_the_material(kerf_mm: float) -> None:
    wanted = plate().polygon(1e-5)
    cut = compensated(plate(), kerf_mm)
    grown = wanted.buffer(kerf_mm / 2, quad_segs=200)
    assert cut.polygon(1e-5).symmetric_difference(grown).area < 0.02
    assert [hole.diameter_mm for hole in cut.holes] == pytest.approx([4 - kerf_mm, 3 - kerf_mm])
    assert cut.polygon(1e-5).area == pytest.approx(cut.area_mm2, abs=0.02)


def test_a_kerf_of_its_own_goes_before_the_sheets() -> None:
    own = replace(plate(), kerf_mm=0.5)
    assert compensated(own, 0.1) == compensated(own, 0.3)
    assert compensated(own, 0.1).size_mm == pytest.approx((60.5, 30.5))


@pytest.mark.parametrize("kerf_mm", [-0.1, float("nan"), float("inf")])
def test_a_kerf_that_is_none_is_refused(kerf_mm: float) -> None:
    with pytest.raises(PatternError, match="plate: the kerf is"):
        compensated(plate(), kerf_mm)


def test_a_kerf_wider_than_a_hole_or_corner_is_refused() -> None:
    with pytest.raises(PatternError, match="hole of 3 mm cannot be cut with a kerf of 3 mm"):
        compensated(plate(), 3.0)
    with pytest.raises(PatternError, match=r"inner corner of radius 1\.5 mm"):
        compensated(replace(plate(), holes=()), 3.0)


def test_inner_lines_come_before_the_outside_and_pieces_one_after_another() -> None:
    pieces = [plate(70.0 * (k % 3), 40.0 * (k // 3), f"plate {k}") for k in (4, 0, 5, 2, 1, 3)]
    cuts = cuts_in_order(pieces, 0.2, 1.5)
    names = [cut.piece for cut in cuts]
    assert len(set(names)) == 6
    for k in range(0, len(cuts), 4):
        assert len(set(names[k : k + 4])) == 1
        assert [cut.inner for cut in cuts[k : k + 4]] == [True, True, True, False]


def test_the_head_goes_to_the_nearest() -> None:
    pieces = [plate(0.0, 40.0 * k, f"plate {k}") for k in (3, 0, 2, 1)]
    cuts = cuts_in_order(pieces, 0.0, 0.0)
    assert list(dict.fromkeys(cut.piece for cut in cuts)) == [f"plate {k}" for k in range(4)]
    first = [cut.start_mm for cut in cuts[:4]]
    # the small hole (from its right end), the opening's longest side, the large hole
    assert first[0] == pytest.approx((9.5, 15))
    assert first[2] == pytest.approx((52, 15))
    ways = [(0.0, 0.0), *(cut.start_mm for cut in cuts)]
    assert travel_mm(cuts) == pytest.approx(sum(map(dist, ways[:-1], ways[1:])))
    assert cuts == cuts_in_order(pieces, 0.0, 0.0)


@pytest.mark.parametrize("overcut_mm", [0.0, 1.0, 2.0, 70.0])
def test_the_blade_goes_once_round_and_on(overcut_mm: float) -> None:
    for cut in cuts_in_order([plate()], 0.2, overcut_mm):
        way = cut.polyline(1e-5)
        length = np.hypot(*np.diff(way, axis=0).T).sum()
        once = Cut(cut.piece, cut.line, cut.inner, 0.0).polyline(1e-5)
        round_mm = np.hypot(*np.diff(once, axis=0).T).sum()
        assert length - round_mm == pytest.approx(min(overcut_mm, round_mm), abs=1e-3)
        assert way[: len(once)] == pytest.approx(once)
        assert Polygon(once).exterior.hausdorff_distance(Polygon(way[: len(once)]).exterior) == 0
        assert way[0] == pytest.approx(np.array(cut.start_mm))
        line = Polygon(once).exterior.buffer(1e-4)
        assert all(line.intersects(Polygon([p, p, p])) for p in way[len(once) :: 7])


def test_outsides_run_counter_clockwise_and_inner_lines_clockwise() -> None:
    for cut in cuts_in_order([plate()], 0.2, 0.0):
        assert Polygon(cut.polyline()[:-1]).exterior.is_ccw == (not cut.inner)


def test_the_blade_enters_on_the_longest_side() -> None:
    outside = cuts_in_order([plate()], 0.0, 0.0)[-1]
    way = outside.polyline()
    assert np.hypot(*(way[1] - way[0])) == pytest.approx(57)


def test_a_hole_is_cut_on_its_circle() -> None:
    cut = next(cut for cut in cuts_in_order([plate()], 0.5, 0.0) if isinstance(cut.line, Hole))
    way = cut.polyline(1e-6)
    assert np.hypot(*(way - (8, 15)).T) == pytest.approx(1.25)
    assert Polygon(way[:-1]).area == pytest.approx(pi * 1.25**2, rel=1e-4)


@pytest.mark.parametrize("overcut_mm", [-0.5, float("nan")])
def test_a_negative_overcut_is_refused(overcut_mm: float) -> None:
    with pytest.raises(PatternError, match="the overcut is"):
        cuts_in_order([plate()], 0.2, overcut_mm)


def test_nothing_is_cut_of_nothing() -> None:
    assert cuts_in_order([], 0.2, 1.0) == ()
    assert travel_mm(()) == 0
