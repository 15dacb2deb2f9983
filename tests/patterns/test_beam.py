from dataclasses import replace
from math import atan2, pi, tan

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import Polygon
from shapely.affinity import scale

from patterns.beam import Beam, ConstraintStrip
from patterns.cut_piece import CutPiece, Hole, numbered
from patterns.errors import PatternError
from patterns.hooks import Barb, SleevePlace, sleeves_on_left_halves
from patterns.rivets import RivetHoles, joined_segments


def rounding_mm2(radius_mm: float, turn_rad: float) -> float:
    """Between an arc and the corner that it rounds."""
    return radius_mm**2 * (tan(turn_rad / 2) - turn_rad / 2)


def barb_mm2(barb: Barb) -> float:
    """A trapezoid; its two tips lose and its two feet win area by being round."""
    ramp, lean = atan2(barb.height_mm, barb.ramp_mm), atan2(barb.undercut_mm, barb.height_mm)
    face = pi / 2 + lean
    sharp = barb.height_mm * (barb.root_mm + barb.land_mm + barb.undercut_mm) / 2
    turned = (ramp, face)
    won = sum(rounding_mm2(barb.foot_radius_mm, turn) for turn in turned)
    return sharp + won - sum(rounding_mm2(barb.tip_radius_mm, turn) for turn in turned)


def beam(segments: int = 2, sleeve_mm: float = 40.0, width_mm: float = 12.0) -> Beam:
    rivets = joined_segments(segments, 100.0, 8.0, 3.0)
    sleeves = sleeves_on_left_halves(rivets, sleeve_mm)
    return Beam(100.0 * segments + 16, width_mm, rivets, 2.0, sleeves)


def assert_sound(piece: CutPiece) -> None:
    polygon = piece.polygon(1e-5)
    assert polygon.is_valid
    assert polygon.exterior.is_simple
    ring = piece.outside.ring()
    assert len({(round(x, 6), round(y, 6)) for x, y in ring.tolist()}) == len(ring)
    assert Polygon(piece.outside.ring()).exterior.is_ccw
    assert polygon.area == pytest.approx(piece.area_mm2, abs=0.01)


@settings(deadline=None, max_examples=40)
@given(
    st.integers(1, 3),
    st.floats(12.0, 20.0),
    st.floats(5.0, 45.0),
    st.floats(0.5, 6.0),
    st.builds(
        Barb,
        height_mm=st.floats(1.2, 3.0),
        undercut_mm=st.floats(0.1, 0.6),
        land_mm=st.floats(0.6, 2.0),
        ramp_mm=st.floats(1.0, 3.5),
        foot_radius_mm=st.floats(0.1, 0.4),
        tip_radius_mm=st.floats(0.1, 0.4),
    ),
)
def test_the_area_is_that_of_its_parts(
    segments: int, width_mm: float, sleeve_mm: float, corner_mm: float, barb: Barb
) -> None:
    plain = beam(segments, sleeve_mm, width_mm)
    # room for a barb between the hole in the middle of a half and the strip's corner
    longer = replace(plain, corner_radius_mm=min(corner_mm, 2.0), barb=barb)
    piece = longer.piece()
    expected = (
        longer.length_mm * width_mm
        - (4 - pi) * longer.corner_radius_mm**2
        - (segments + 1) * pi * 9 / 4
        + 4 * segments * barb_mm2(barb)
    )
    assert piece.area_mm2 == pytest.approx(expected, abs=1e-9)
    assert_sound(piece)


def test_the_sleeve_lies_between_faces_that_lean_over_it() -> None:
    short = beam(1)
    (sleeve,) = short.sleeves
    outside = short.piece().polygon(1e-4)
    foot, edge = sleeve.start_mm - short.length_mm / 2, short.width_mm / 2
    held = Polygon(
        [(foot + x, edge + y) for x, y in [(0.6, 0.01), (39.4, 0.01), (39.4, 2), (0.6, 2)]]
    )
    assert held.intersection(outside).is_empty
    tip = short.barb.height_mm - 0.4
    for x, way in ((foot, 1), (foot + sleeve.length_mm, -1)):
        beyond = Polygon(
            [(x + way * u, edge + v) for u, v in [(0.05, tip - 0.2), (0.25, tip), (0.05, tip)]]
        )
        assert outside.covers(beyond)
        assert outside.bounds[3] == pytest.approx(edge + short.barb.height_mm)


def test_beams_are_the_same_upside_down() -> None:
    polygon = beam().piece().polygon()
    mirrored = scale(polygon, 1, -1, origin=(0, 0))
    assert polygon.symmetric_difference(mirrored).area < 1e-9


def test_holes_stay_circles_at_ends_and_joints() -> None:
    assert beam().piece().holes == (Hole(-100, 0, 3), Hole(0, 0, 3), Hole(100, 0, 3))


def test_sleeves_are_centred_between_hole_and_middle() -> None:
    first, second = beam().sleeves
    assert first.start_mm - (8 + 1.5) == pytest.approx(58 - first.end_mm)
    assert (second.start_mm, second.length_mm) == pytest.approx((first.start_mm + 100, 40))


def test_a_constraint_strip_with_round_ends() -> None:
    strip = ConstraintStrip(106.0, 12.0, joined_segments(1, 94.0, 6.0, 3.0), 6.0)
    piece = strip.piece()
    assert strip.hole_distance_mm == 94.0
    assert piece.area_mm2 == pytest.approx(94 * 12 + 36 * pi - 2 * pi * 9 / 4)
    assert piece.size_mm == pytest.approx((106, 12))
    assert_sound(piece)


def test_a_constraint_strip_with_a_window() -> None:
    rivets = joined_segments(1, 94.0, 6.0, 3.0)
    strip = ConstraintStrip(106.0, 50.0, rivets, 2.0, window_mm=42.0)
    piece = strip.piece()
    rounding = (4 - pi) * 2**2  # of four corners, outside and inside alike
    assert piece.area_mm2 == pytest.approx(106 * 50 - (94 - 12) * 42 - 2 * pi * 9 / 4)
    (window,) = piece.openings
    assert window.area_mm2 == pytest.approx(rounding - (94 - 12) * 42)
    # it ends 6 mm from the holes' centres, as the strip does
    assert np.ptp(window.ring(), axis=0) == pytest.approx((94 - 12, 42), abs=1e-3)
    assert_sound(piece)
    with pytest.raises(PatternError, match="must be narrower"):
        ConstraintStrip(106.0, 42.0, rivets, 2.0, window_mm=42.0)
    short = ConstraintStrip(20.0, 50.0, joined_segments(1, 8.0, 6.0, 3.0), 2.0, 42.0)
    with pytest.raises(PatternError, match="no room for a window"):
        short.piece()


def test_the_mass_is_that_of_polycarbonate() -> None:
    # 1.2 g/cm3: a square metre of 1 mm weighs 1.2 kg
    strip = ConstraintStrip(1000.0, 1000.0, joined_segments(1, 900.0, 50.0, 1e-3), 1e-3)
    assert strip.piece().mass_g(1.0) == pytest.approx(1200)
    assert strip.piece().mass_g() == pytest.approx(456)
    assert strip.piece().mass_g(1.0, 2.4) == pytest.approx(2400)


def test_pieces_turn_and_move_as_a_whole() -> None:
    piece = beam().piece()
    turned = piece.quarter_turned().moved(50, 7)
    assert turned.area_mm2 == pytest.approx(piece.area_mm2)
    assert turned.size_mm == pytest.approx(piece.size_mm[::-1])
    assert turned.holes[0] == Hole(50, -93, 3)
    assert turned.polygon().is_valid


def test_copies_are_numbered() -> None:
    assert [one.name for one in numbered(beam().piece(), 3)] == ["beam 1", "beam 2", "beam 3"]


@pytest.mark.parametrize("wrong", [0.0, -3.0, float("nan"), float("inf")])
def test_quantities_that_are_not_positive_are_named(wrong: float) -> None:
    good = beam()
    with pytest.raises(PatternError, match=f"no strip when width_mm is {wrong:g}: each must be"):
        replace(good, width_mm=wrong)
    with pytest.raises(PatternError, match="no barb when height_mm"):
        Barb(height_mm=wrong)
    with pytest.raises(PatternError, match="no sleeve when length_mm"):
        SleevePlace(3.0, wrong)
    with pytest.raises(PatternError, match="row of rivet holes when diameter_mm"):
        RivetHoles(wrong, (1.0, 2.0))
    with pytest.raises(PatternError, match=r"segment_mm is .* and end_mm is"):
        joined_segments(1, wrong, wrong, 3.0)


@pytest.mark.parametrize("positions", [(), (5.0,), (5.0, 5.0), (9.0, 5.0), (5.0, float("inf"))])
def test_rivet_holes_must_rise(positions: tuple[float, ...]) -> None:
    with pytest.raises(PatternError, match="two or more, rising"):
        RivetHoles(3.0, positions)


def test_a_sleeve_must_start_somewhere() -> None:
    with pytest.raises(PatternError, match="starts at nan"):
        SleevePlace(float("nan"), 3.0)
