from collections import Counter
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import box

from patterns.cut_piece import CutPiece, Hole
from patterns.errors import PatternError
from patterns.mat import MATS, Mat
from patterns.nest_rules import NestedMat, check_mat, check_nest
from patterns.nesting import nest
from patterns.rounding import Corner, rounded

SMALL = MATS["scanncut-12x12"]


def board(width_mm: float, height_mm: float, name: str = "board") -> CutPiece:
    places = ((0, 0), (width_mm, 0), (width_mm, height_mm), (0, height_mm))
    outside = rounded([Corner(x - 7, y + 3, 0.5) for x, y in places])
    return CutPiece(name, outside, (Hole(-5.5, 4.5, 1.0),))


@settings(deadline=None, max_examples=40)
@given(
    st.lists(st.tuples(st.floats(5, 290), st.floats(5, 120)), min_size=1, max_size=25),
    st.floats(0.5, 8),
    st.floats(0, 5),
    st.booleans(),
)
def test_every_piece_lies_apart_within_the_margins(
    sizes: list[tuple[float, float]], spacing_mm: float, margin_mm: float, wide: bool
) -> None:
    mat = replace(SMALL, margin_mm=margin_mm) if not wide else Mat(600.0, 200.0, margin_mm)
    if wide:
        sizes = [(width, min(height, 100)) for width, height in sizes]
    sizes = [(min(width, 285), height) for width, height in sizes]
    pieces = [board(*size, f"board {k}") for k, size in enumerate(sizes)]
    nested = nest(pieces, mat, spacing_mm)
    assert Counter(p.name for one in nested for p in one.pieces) == Counter(p.name for p in pieces)
    areas = {piece.name: piece.area_mm2 for piece in pieces}
    room = box(margin_mm, margin_mm, mat.width_mm - margin_mm, mat.height_mm - margin_mm)
    for one in nested:
        assert one.pieces
        assert check_nest(one, 0.0) == ()
        shapes = [piece.polygon() for piece in one.pieces]
        for k, shape in enumerate(shapes):
            assert room.buffer(1e-6).covers(shape)
            assert shape.is_valid
            assert one.pieces[k].area_mm2 == pytest.approx(areas[one.pieces[k].name])
            assert all(shape.distance(o) >= spacing_mm - 1e-6 for o in shapes[k + 1 :])


def test_a_full_mat_is_followed_by_another() -> None:
    # 290.67 x 292.8 mm between the margins hold two columns of 20 boards of 140 x 12.7 mm
    pieces = [board(140, 12.7)] * 41
    assert [len(one.pieces) for one in nest(pieces, SMALL, 2.0)] == [40, 1]


def test_what_fits_only_turned_is_turned() -> None:
    tall = Mat(100.0, 400.0, 0.0)
    (one,) = nest([board(300, 40)], tall, 1.0)
    assert one.pieces[0].size_mm == pytest.approx((40, 300))
    hole = one.pieces[0].holes[0]
    assert (hole.x_mm, hole.y_mm) == pytest.approx((38.5, 1.5))


def test_the_way_that_takes_less_is_kept() -> None:
    # along y three boards of 90 mm stand beside each other on 270 x 100 mm; along x it is one a row
    (one,) = nest([board(140, 90)] * 3, Mat(280.0, 145.0, 0.0), 1.0)
    assert all(piece.size_mm == pytest.approx((90, 140)) for piece in one.pieces)


def test_the_same_pieces_come_out_the_same() -> None:
    pieces = [board(30 + k % 5, 10 + k % 3, f"board {k}") for k in range(30)]
    assert nest(pieces, SMALL, 2.0) == nest(pieces, SMALL, 2.0)
    assert nest([], SMALL, 2.0) == ()


def test_a_sheet_that_is_too_small_is_refused_in_one_line_a_piece() -> None:
    pieces = [board(50, 50), board(291, 12, "beam 1"), board(300, 10, "beam 2")]
    (fault,) = check_mat(pieces, SMALL)
    assert fault.rule == "mat-size"
    assert "beam 2: 300.00 x 10.00 mm do not fit on 290.67 x 292.80 mm" in str(fault)
    with pytest.raises(PatternError) as caught:
        nest(pieces, SMALL, 2.0)
    assert str(caught.value) == str(fault)
    assert check_mat(pieces, MATS["scanncut-12x24"]) == ()


def test_a_wrong_spacing_is_refused() -> None:
    with pytest.raises(PatternError, match="spacing is -1 mm"):
        nest([board(10, 10)], SMALL, -1.0)


@pytest.mark.parametrize(
    "mat", [(0.0, 5.0, 0.0), (9.0, 20.0, 5.0), (20.0, 9.0, 5.0), (10.0, 10.0, -1.0)]
)
def test_a_mat_without_room_is_refused(mat: tuple[float, float, float]) -> None:
    with pytest.raises(PatternError, match="no mat when"):
        Mat(*mat)


def test_cuts_that_meet_or_leave_the_mat_are_found() -> None:
    apart = (board(20, 20, "a").moved(10, 10), board(20, 20, "b").moved(30.2, 10))
    assert check_nest(NestedMat(SMALL, apart), 0.1) == ()
    (fault,) = check_nest(NestedMat(SMALL, apart), 0.21)
    assert (fault.rule, fault.message) == ("mat-overlap", "the cuts of a and b meet")
    assert fault.x_mm == pytest.approx(23.1, abs=0.01)
    # board() has its lower left corner at (-7, 3)
    (fault,) = check_nest(NestedMat(SMALL, (board(20, 20).moved(7.05, 10),)), 0.2)
    assert fault.rule == "mat-edge"
    assert fault.x_mm < 0
