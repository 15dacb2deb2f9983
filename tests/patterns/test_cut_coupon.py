import numpy as np
import pytest
from shapely import Polygon

from patterns.cut_coupon import hole_coupon, kerf_coupons
from patterns.cut_piece import CutPiece
from patterns.cut_rules import CutLimits, check_piece
from patterns.errors import PatternError
from patterns.kerf import compensated

DIAMETERS = (2.8, 2.9, 3.0, 3.1, 3.2)


def notches_mm(piece: CutPiece) -> list[float]:
    """Where notches are deepest along the lower edge."""
    away = Polygon(piece.outside.ring(1e-4)).convex_hull.difference(
        Polygon(piece.outside.ring(1e-4))
    )
    deep = [part.centroid.x for part in getattr(away, "geoms", [away]) if part.area > 0.5]
    return sorted(deep)


def test_holes_are_counted_by_notches_below_them() -> None:
    piece = hole_coupon(DIAMETERS, 1.5)
    assert tuple(hole.diameter_mm for hole in piece.holes) == DIAMETERS
    assert check_piece(piece, CutLimits()) == ()
    assert piece.polygon().is_valid
    nearest = [
        int(np.argmin([abs(hole.x_mm - x) for hole in piece.holes])) for x in notches_mm(piece)
    ]
    assert nearest == [0, 1, 1, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 4]


@pytest.mark.parametrize("diameters", [(0.6,), (1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0), (6.0, 2.0)])
def test_coupons_of_any_holes_keep_the_rules(diameters: tuple[float, ...]) -> None:
    assert check_piece(hole_coupon(diameters, 1.5), CutLimits()) == ()


def test_squares_step_the_kerf() -> None:
    kerfs = (0.0, 0.1, 0.2, 0.3)
    squares = kerf_coupons(kerfs, 15.0)
    assert [len(notches_mm(square)) for square in squares] == [1, 2, 3, 4]
    for square, kerf in zip(squares, kerfs, strict=True):
        assert square.size_mm == pytest.approx((15, 15))
        assert compensated(square, 9.9).size_mm == pytest.approx((15 + kerf, 15 + kerf))
        assert check_piece(square, CutLimits()) == ()
        assert square.polygon().is_valid


def test_the_area_of_a_square_is_that_of_its_parts() -> None:
    (square,) = kerf_coupons((0.1,), 15.0)
    r2, eighth = 0.09, np.pi / 8
    corner = r2 * (1 - np.pi / 4)
    # a notch of 2 x 1 mm: two outer corners turn by 45 degrees, the inner one by 90
    notch = 1.0 + 2 * r2 * (np.tan(eighth) - eighth) - corner
    assert square.area_mm2 == pytest.approx(225 - 4 * corner - notch, abs=1e-9)


def test_notches_that_have_no_room_are_refused() -> None:
    with pytest.raises(PatternError, match=r"4 squares of 10 mm: .* sides of 12\.5"):
        kerf_coupons((0, 0.1, 0.2, 0.3), 10.0)
    with pytest.raises(PatternError, match="side_mm is nan"):
        kerf_coupons((0, 0.1), float("nan"))
    with pytest.raises(PatternError, match="without a hole"):
        hole_coupon((), 1.5)
    with pytest.raises(PatternError, match="smallest_hole_mm is 0"):
        hole_coupon((0.0, 3.0), 1.5)
