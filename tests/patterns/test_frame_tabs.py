from dataclasses import replace
from math import pi

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import Polygon, box, get_parts
from shapely.affinity import translate

from patterns.beam import Beam
from patterns.cut_rules import CutLimits, check_piece
from patterns.errors import PatternError
from patterns.frame_tabs import Frame, framed_beams
from patterns.hooks import sleeves_on_left_halves
from patterns.rivets import joined_segments

RIVETS = joined_segments(1, 100.0, 8.0, 3.0)
BEAM = Beam(116.0, 12.0, RIVETS, 2.0, sleeves_on_left_halves(RIVETS, 40.0))


@settings(deadline=None, max_examples=25)
@given(st.integers(1, 7), st.floats(17.0, 60.0), st.floats(0.9, 4.0), st.floats(0.3, 0.9))
def test_frame_and_beams_are_one_piece(
    count: int, pitch_mm: float, tab_mm: float, radius_mm: float
) -> None:
    frame = Frame(pitch_mm, tab_mm, tab_radius_mm=radius_mm)
    piece = framed_beams(BEAM, count, frame)
    polygon = piece.polygon(1e-5)
    assert polygon.is_valid
    assert polygon.geom_type == "Polygon"
    assert len(piece.openings) == count + 1
    assert len(piece.holes) == 2 * count
    own = BEAM.piece()
    window = (116 + 2 * 4) * count * pitch_mm - (4 - pi) * radius_mm**2
    tabs = 2 * (4 * tab_mm + 4 * (1 - pi / 4) * radius_mm**2)
    around = 140 * (count * pitch_mm + 16) - (4 - pi) * 9
    expected = around - window + count * (own.area_mm2 + tabs)
    assert piece.area_mm2 == pytest.approx(expected)
    assert polygon.area == pytest.approx(expected, abs=0.05)
    assert check_piece(piece, CutLimits()) == ()


def test_cutting_the_tabs_frees_beams_at_the_pitch() -> None:
    piece = framed_beams(BEAM, 3, Frame(38.0))
    polygon = piece.polygon(1e-4)
    # knives across all tabs, clear of their round corners; the frame falls apart too
    knives = box(-60.1, -56, -59.9, 56).union(box(59.9, -56, 60.1, 56))
    parts = get_parts(polygon.difference(knives)).tolist()
    beams = sorted((p for p in parts if p.bounds[2] < 60), key=lambda p: p.bounds[1])
    assert len(beams) == 3
    between_ends = box(-57, -80, 57, 80)
    for axis, one in zip((-38, 0, 38), beams, strict=True):
        wanted = translate(BEAM.piece().polygon(1e-4), 0, axis).intersection(between_ends)
        assert one.intersection(between_ends).symmetric_difference(wanted).area < 1e-6


def test_no_needle_meets_the_frame_within_half_a_pitch() -> None:
    piece = framed_beams(BEAM, 2, Frame(40.0))
    sleeves = box(-58, -40, 58, 40)
    plastic = piece.polygon().intersection(sleeves)
    beams = [translate(BEAM.piece().polygon(), 0, y) for y in (-20, 20)]
    assert plastic.area == pytest.approx(sum(beam.area for beam in beams), abs=1)


def test_openings_run_clockwise_inside_the_outside() -> None:
    piece = framed_beams(BEAM, 2, Frame(40.0))
    outside = Polygon(piece.outside.ring())
    assert outside.exterior.is_ccw
    for opening in piece.openings:
        assert not Polygon(opening.ring()).exterior.is_ccw
        assert outside.contains_properly(Polygon(opening.ring()))


def test_a_tab_thinner_than_the_web_is_found() -> None:
    piece = framed_beams(BEAM, 1, Frame(40.0, tab_width_mm=0.6))
    (fault,) = check_piece(piece, CutLimits())
    assert (fault.rule, fault.actual) == ("web", pytest.approx(0.6))
    assert abs(fault.y_mm) < 1e-6


def test_beams_that_would_meet_are_refused() -> None:
    with pytest.raises(PatternError, match="pitch of 15 mm: it must be greater than 15 mm"):
        framed_beams(BEAM, 2, Frame(15.0))
    plain = replace(BEAM, sleeves=())
    assert framed_beams(plain, 2, Frame(15.0)).polygon().is_valid


def test_tabs_without_room_are_refused() -> None:
    with pytest.raises(PatternError, match="long: its corners"):
        framed_beams(BEAM, 2, Frame(40.0, tab_length_mm=0.9))
    with pytest.raises(PatternError, match="long: its corners"):
        framed_beams(BEAM, 2, Frame(40.0, tab_width_mm=7.5))


def test_quantities_are_named() -> None:
    with pytest.raises(PatternError, match="no frame when border_mm is 0"):
        Frame(40.0, border_mm=0.0)
    with pytest.raises(PatternError, match="no frame when beams is 0"):
        framed_beams(BEAM, 0, Frame(40.0))
