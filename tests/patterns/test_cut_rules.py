from dataclasses import replace

import pytest

from patterns.beam import Beam, ConstraintStrip
from patterns.beam_rules import check_beam, check_constraint
from patterns.cut_piece import CutPiece, Hole
from patterns.cut_rules import CutLimits, check_piece
from patterns.hooks import Barb, SleevePlace, sleeves_on_left_halves
from patterns.rivets import RivetHoles, joined_segments
from patterns.rounding import Corner, rounded
from patterns.violation import Violation

LIMITS = CutLimits()
RIVETS = joined_segments(2, 100.0, 8.0, 3.0)
BEAM = Beam(216.0, 12.0, RIVETS, 2.0, sleeves_on_left_halves(RIVETS, 40.0))
STRIP = ConstraintStrip(106.0, 12.0, joined_segments(1, 94.0, 6.0, 3.0), 2.0)


def box(x0: float, y0: float, x1: float, y1: float, radius_mm: float = 1.0):
    return rounded([Corner(*at, radius_mm) for at in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))])


def plate(*holes: Hole) -> CutPiece:
    return CutPiece("plate", box(0, 0, 40, 20), holes)


def only(faults: tuple[Violation, ...]) -> Violation:
    (fault,) = faults
    assert "\n" not in str(fault)
    return fault


def of_beam(**changes: object) -> Violation:
    return only(check_beam(replace(BEAM, **changes), LIMITS))


def found(fault: Violation) -> tuple[str, float | None, float | None]:
    return fault.rule, pytest.approx(fault.actual, abs=1e-9), fault.allowed


def test_good_pieces_break_no_rule() -> None:
    assert check_beam(BEAM, LIMITS) == ()
    assert check_constraint(STRIP, BEAM, LIMITS) == ()


def test_a_hole_near_the_long_edge_is_found_from_its_edge() -> None:
    # the width of 12 mm leaves exactly 1.5 diameters beside a hole of 3 mm
    faults = check_beam(replace(BEAM, width_mm=11.9), LIMITS)
    assert [fault.rule for fault in faults] == ["hole-edge"] * 3
    assert found(faults[0]) == ("hole-edge", 4.45, 4.5)
    assert str(faults[0]) == (
        "hole-edge: beam: the hole of 3 mm has less than 1.5 diameters beside it "
        "at (-100.00, 0.00) mm: 4.450 (allowed 4.500)"
    )


def test_a_hole_near_the_end_is_found() -> None:
    rivets = replace(RIVETS, positions_mm=(5.9, 108.0, 208.0))
    assert found(of_beam(rivets=rivets)) == ("hole-edge", 4.4, 4.5)


@pytest.mark.parametrize(("x_mm", "left"), [(1.0, -0.5), (-2.0, -3.5)])
def test_a_hole_off_the_beam_is_found_once(x_mm: float, left: float) -> None:
    rivets = replace(RIVETS, positions_mm=(x_mm, 108.0, 208.0))
    fault = of_beam(rivets=rivets, sleeves=(SleevePlace(10.0, 40.0), BEAM.sleeves[1]))
    assert found(fault) == ("hole-off", left, 4.5)
    assert fault.x_mm == x_mm - 108


def test_a_hole_in_an_opening_is_off_the_piece() -> None:
    piece = replace(plate(Hole(20, 10, 1)), openings=(box(10, 5, 30, 15).reversed(),))
    assert found(only(check_piece(piece, LIMITS))) == ("hole-off", -5.5, 1.5)


def test_a_thin_web_between_holes_is_found() -> None:
    fault = only(check_piece(plate(Hole(17, 10, 2), Hole(19.5, 10, 2)), LIMITS))
    assert found(fault) == ("web", 0.5, 0.8)
    overlapping = check_piece(plate(Hole(17, 10, 2), Hole(18.5, 10, 2)), LIMITS)
    assert found(only(overlapping)) == ("web", -0.5, 0.8)


def test_a_thin_web_beside_an_opening_is_found() -> None:
    piece = replace(plate(), openings=(box(0.7, 5, 30, 15).reversed(),))
    fault = only(check_piece(piece, LIMITS))
    assert found(fault) == ("web", 0.7, 0.8)
    assert fault.x_mm == pytest.approx(0.35)
    apart = (box(5, 5, 15, 15).reversed(), box(15.6, 5, 30, 15).reversed())
    fault = only(check_piece(replace(plate(), openings=apart), LIMITS))
    assert found(fault) == ("web", 0.6, 0.8)


def test_lines_that_cross_are_found() -> None:
    piece = replace(plate(), openings=(box(-5, 5, 30, 15).reversed(),))
    assert only(check_piece(piece, LIMITS)).rule == "cut-shape"


def test_the_smallest_inner_radius_is_found() -> None:
    piece = replace(plate(), openings=(box(10, 5, 30, 15, 0.2).reversed(),))
    assert found(only(check_piece(piece, LIMITS))) == ("inner-radius", 0.2, 0.25)
    assert found(only(check_piece(plate(Hole(20, 10, 0.4)), LIMITS))) == (
        "inner-radius",
        0.2,
        0.25,
    )
    barb = Barb(foot_radius_mm=0.2)
    assert found(of_beam(barb=barb)) == ("inner-radius", 0.2, 0.25)


def test_a_sleeve_longer_than_half_a_segment_is_found() -> None:
    long = SleevePlace(10.0, 50.5)
    fault = of_beam(sleeves=(long, BEAM.sleeves[1]))
    assert found(fault) == ("sleeve-length", 50.5, 50.0)
    assert "longer than half" in fault.message


@pytest.mark.parametrize(("start_mm", "past"), [(20.0, 2.0), (9.0, 0.5), (56.0, 2.0)])
def test_a_sleeve_over_a_hole_or_past_its_half_is_found(start_mm: float, past: float) -> None:
    beam = replace(BEAM, length_mm=116.0, rivets=joined_segments(1, 100.0, 8.0, 3.0))
    fault = only(check_beam(replace(beam, sleeves=(SleevePlace(start_mm, 40.0),)), LIMITS))
    assert found(fault) == ("sleeve-place", past, 0.0)


def test_a_sleeve_on_the_right_half_is_fine() -> None:
    right = (SleevePlace(62.0, 40.0), SleevePlace(162.0, 40.0))
    assert check_beam(replace(BEAM, sleeves=right), LIMITS) == ()


def test_hooks_past_either_end_are_found() -> None:
    first, second = BEAM.sleeves
    early = of_beam(sleeves=(replace(first, start_mm=6.0), second))
    assert found(early) == ("hook-place", 1.6, 2.0)
    assert "begins" in early.message
    late = of_beam(sleeves=(first, replace(second, start_mm=171.0)))
    assert found(late) == ("hook-place", 215.4, 214.0)
    assert "ends" in late.message


def test_hooks_that_meet_are_found() -> None:
    first, second = BEAM.sleeves
    fault = of_beam(sleeves=(first, replace(second, start_mm=first.end_mm + 8.5)))
    assert found(fault) == ("hook-place", -0.3, 0.0)
    assert "meet" in fault.message


def test_a_barb_without_room_for_its_corners_is_found() -> None:
    fault = of_beam(barb=Barb(height_mm=0.5))
    assert fault.rule == "cut-shape"
    assert "need" in fault.message
    fault = only(check_constraint(replace(STRIP, corner_radius_mm=6.1), BEAM, LIMITS))
    assert fault.rule == "cut-shape"


@pytest.mark.parametrize("distance_mm", [100.0, 101.0])
def test_a_constraint_that_does_not_buckle_its_segment_is_found(distance_mm: float) -> None:
    rivets = joined_segments(1, distance_mm, 6.0, 3.0)
    strip = ConstraintStrip(distance_mm + 12, 12.0, rivets, 2.0)
    single = replace(BEAM, length_mm=116.0, rivets=joined_segments(1, 100.0, 8.0, 3.0))
    fault = only(check_constraint(strip, single, LIMITS))
    assert found(fault) == ("constraint-length", distance_mm, 100.0)


def test_each_segment_is_compared_with_the_constraint() -> None:
    uneven = replace(BEAM, rivets=RivetHoles(3.0, (8.0, 100.0, 208.0)))
    fault = only(check_constraint(STRIP, uneven, LIMITS))
    assert (fault.allowed, fault.x_mm) == (92.0, -54.0)


def test_a_window_too_narrow_for_the_beam_and_its_hooks_is_found() -> None:
    widest = BEAM.width_mm + 2 * BEAM.hook_height_mm
    wide = replace(STRIP, width_mm=widest + 10, window_mm=widest + 0.1)
    assert not check_constraint(wide, BEAM, LIMITS)
    fault = only(check_constraint(replace(wide, window_mm=widest - 0.1), BEAM, LIMITS))
    assert found(fault) == ("constraint-window", pytest.approx(widest - 0.1), widest)


def test_a_constraint_is_checked_as_a_piece() -> None:
    assert check_constraint(replace(STRIP, width_mm=11.0), BEAM, LIMITS)[0].rule == "hole-edge"
