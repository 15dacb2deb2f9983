import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import Polygon

from patterns.contour import Contour
from patterns.errors import PatternError
from patterns.path import Arc
from patterns.rounding import Corner, rounded

SQUARE = ((0, 0), (10, 0), (10, 10), (0, 10))
ELL = ((0, 0), (20, 0), (20, 8), (9, 8), (9, 15), (0, 15))


def of(places: tuple[tuple[float, float], ...], radius_mm: float = 1.0) -> Contour:
    return rounded([Corner(x, y, radius_mm) for x, y in places])


def unrolled(contour: Contour) -> np.ndarray:
    """Points from vertices and bulges alone, as a CAD program makes them."""
    points = []
    vertices = contour.vertices()
    for (x, y, bulge), (u, v, _) in zip(vertices, np.roll(vertices, -1, axis=0), strict=True):
        start, end = complex(x, y), complex(u, v)
        if bulge == 0:
            points.append(start)
            continue
        half = 2 * np.arctan(bulge)
        centre = (start + end) / 2 + 1j * (end - start) / 2 / np.tan(half)
        points += [centre + (start - centre) * np.exp(2j * half * k / 200) for k in range(200)]
    return np.array([(p.real, p.imag) for p in points])


@settings(deadline=None, max_examples=30)
@given(st.floats(0.01, 5.0))
def test_a_rounded_square_has_its_exact_area(radius_mm: float) -> None:
    contour = of(SQUARE, radius_mm)
    assert contour.area_mm2 == pytest.approx(100 - (4 - np.pi) * radius_mm**2, abs=1e-12)


def test_five_convex_corners_and_one_inner_one() -> None:
    corner = 1 - np.pi / 4
    assert of(ELL).area_mm2 == pytest.approx(20 * 8 + 9 * 7 - 4 * corner, abs=1e-12)
    sharpest = of(ELL).sharpest_inner
    assert sharpest is not None
    assert (sharpest.centre_x_mm, sharpest.centre_y_mm) == pytest.approx((10, 9))
    assert of(SQUARE).sharpest_inner is None


def test_pieces_join_without_gaps_or_kinks() -> None:
    contour = of(ELL, 1.7)
    again = Contour((*contour.pieces, contour.pieces[0]))
    gaps, kinks = again.path.joints()
    assert gaps.max() < 1e-12
    assert kinks.max() < 1e-12


def test_a_radius_of_half_a_side_leaves_no_straight_piece() -> None:
    contour = of(SQUARE, 5.0)
    assert all(isinstance(piece, Arc) for piece in contour.pieces)
    assert contour.area_mm2 == pytest.approx(25 * np.pi)


@pytest.mark.parametrize("radius_mm", [0.0, -1.0, float("nan")])
def test_sharp_corners_are_refused(radius_mm: float) -> None:
    with pytest.raises(PatternError, match=r"corner at \(0, 0\) mm .* greater than 0"):
        of(SQUARE, radius_mm)


def test_corners_without_room_are_refused() -> None:
    with pytest.raises(PatternError, match=r"10\.000 mm long: .* need 10\.200 mm"):
        of(SQUARE, 5.1)
    with pytest.raises(PatternError, match="lie on one another"):
        of(((0, 0), (0, 0), (1, 1)), 0.1)


def test_flat_corners_need_no_arc() -> None:
    contour = of(((0, 0), (5, 0), *SQUARE[1:]))
    assert contour.area_mm2 == pytest.approx(of(SQUARE).area_mm2)
    assert len(contour.pieces) == len(of(SQUARE).pieces) + 1


@pytest.mark.parametrize("places", [SQUARE, ELL])
def test_bulges_say_the_same_as_the_pieces(places: tuple[tuple[float, float], ...]) -> None:
    contour = of(places, 2.0)
    drawn = Polygon(unrolled(contour))
    assert drawn.area == pytest.approx(contour.area_mm2, rel=1e-5)
    assert drawn.symmetric_difference(Polygon(contour.ring(1e-5))).area < 2e-3


def test_the_ring_is_closed_once_and_keeps_the_tolerance() -> None:
    contour = of(ELL, 3.0)
    for tolerance in (0.1, 0.01, 0.001):
        ring = contour.ring(tolerance)
        assert not np.array_equal(ring[0], ring[-1])
        steps = np.hypot(*(np.roll(ring, -1, axis=0) - ring).T)
        assert steps.min() > 1e-6
        away = Polygon(ring).exterior.hausdorff_distance(Polygon(contour.ring(1e-6)).exterior)
        assert away <= tolerance * 1.001


def test_moving_turning_and_reversing() -> None:
    contour = of(ELL, 1.5)
    assert contour.reversed().area_mm2 == pytest.approx(-contour.area_mm2)
    back = Polygon(contour.reversed().ring())
    assert back.exterior.hausdorff_distance(Polygon(contour.ring()).exterior) < 1e-9
    assert not back.exterior.is_ccw
    shifted = contour.moved(3, -4).ring()
    assert shifted == pytest.approx(contour.ring() + np.array([3, -4]))
    x, y = contour.ring().T
    assert contour.quarter_turned().ring() == pytest.approx(np.stack([-y, x], axis=1))


def test_the_start_moves_to_the_longest_line() -> None:
    contour = Contour((*of(ELL).pieces[3:], *of(ELL).pieces[:3]))
    first = contour.from_longest_line()
    assert first.pieces[0].length_mm == max(piece.length_mm for piece in contour.pieces) == 18
    assert first.area_mm2 == pytest.approx(contour.area_mm2)


@settings(deadline=None, max_examples=30)
@given(st.floats(0.0, 1.4), st.floats(1.5, 3.0))
def test_the_offset_is_what_shapely_buffers(by_mm: float, radius_mm: float) -> None:
    contour = of(ELL, radius_mm)
    grown = Polygon(contour.ring(1e-5)).buffer(by_mm, quad_segs=400)
    line = Polygon(contour.offset(by_mm).ring(1e-5)).exterior
    assert line.hausdorff_distance(grown.exterior) < 1e-4


def test_the_offset_of_an_opening_shrinks_it() -> None:
    opening = of(SQUARE).reversed()
    assert abs(opening.offset(0.25).area_mm2) == pytest.approx(9.5**2 - (4 - np.pi) * 0.75**2)


def test_an_inner_corner_sharper_than_the_offset_is_refused() -> None:
    with pytest.raises(PatternError, match=r"radius 0\.3 mm cannot be cut 0\.3 mm"):
        of(ELL, 0.3).offset(0.3)
