"""Rules of beams, the sleeves that they hold and the constraint strips that buckle them."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from patterns.beam import Beam, ConstraintStrip
from patterns.cut_rules import CutLimits, check_piece
from patterns.errors import PatternError
from patterns.hooks import SleevePlace
from patterns.violation import Violation

_ROUNDOFF_MM = 1e-9


def check_beam(beam: Beam, limits: CutLimits, name: str = "beam") -> tuple[Violation, ...]:
    """Check where a beam holds its sleeves, and then its piece.

    Returns
    -------
    tuple of Violation
        Places are in the piece's coordinates: the beam's centre is the origin. The piece is checked
        only when barbs have their place.
    """
    faults = [*_check_hooks(beam, name), *_check_hooks_apart(beam, name)]
    if faults:
        return tuple(faults)
    return (*_check_sleeves(beam, name), *_check_own(beam, name, limits))


def check_constraint(
    strip: ConstraintStrip, beam: Beam, limits: CutLimits, name: str = "constraint"
) -> tuple[Violation, ...]:
    """Check a constraint strip against every segment of the beam, and then its piece."""
    faults = [
        Violation(
            "constraint-length",
            f"{name}: its holes are not nearer to one another than those of the beam",
            (start + end - beam.length_mm) / 2,
            0.0,
            actual=strip.hole_distance_mm,
            allowed=end - start,
        )
        for start, end in beam.rivets.segments_mm
        if strip.hole_distance_mm >= end - start - _ROUNDOFF_MM
    ]
    widest = beam.width_mm + 2 * beam.hook_height_mm
    if 0 < strip.window_mm <= widest + _ROUNDOFF_MM:
        message = f"{name}: the beam with its hooks does not pass through its window"
        actual, allowed = strip.window_mm, widest
        faults.append(
            Violation("constraint-window", message, 0.0, 0.0, actual=actual, allowed=allowed)
        )
    return (*faults, *_check_own(strip, name, limits))


def _check_own(
    strip: Beam | ConstraintStrip, name: str, limits: CutLimits
) -> tuple[Violation, ...]:
    """Check the piece, if its round corners have room."""
    try:
        piece = strip.piece(name)
    except PatternError as error:
        return (Violation("cut-shape", f"{name}: {error};", 0.0, 0.0),)
    return check_piece(piece, limits)


def _check_hooks(beam: Beam, name: str) -> Iterator[Violation]:
    """All of a barb stands on the straight part of the edge."""
    first = beam.corner_radius_mm
    last = beam.length_mm - first
    for sleeve in beam.sleeves:
        begin, end = _reach_mm(beam, sleeve)
        message = f"{name}: the hook of a sleeve passes the straight edge and begins"
        if begin < first - _ROUNDOFF_MM:
            yield _on_axis(beam, begin, "hook-place", message, (begin, first))
        if end > last + _ROUNDOFF_MM:
            yield _on_axis(beam, end, "hook-place", message.replace("begins", "ends"), (end, last))


def _check_hooks_apart(beam: Beam, name: str) -> Iterator[Violation]:
    for left, right in pairwise(beam.sleeves):
        (_, end), (begin, _) = _reach_mm(beam, left), _reach_mm(beam, right)
        if begin < end - _ROUNDOFF_MM:
            message = f"{name}: the hooks of neighbouring sleeves meet; the room between them is"
            yield _on_axis(beam, begin, "hook-place", message, (begin - end, 0.0))


def _reach_mm(beam: Beam, sleeve: SleevePlace) -> tuple[float, float]:
    """Where a sleeve's barbs begin and end, from the strip's left end."""
    reach = beam.barb.reach_mm
    return sleeve.start_mm - reach, sleeve.end_mm + reach


def _check_sleeves(beam: Beam, name: str) -> Iterator[Violation]:
    """A sleeve is not longer than half a segment, and lies within one half, beside the hole."""
    for sleeve in beam.sleeves:
        middle = (sleeve.start_mm + sleeve.end_mm) / 2
        start, end = _segment_mm(beam, middle)
        half, turn = (end - start) / 2, (start + end) / 2
        edge = beam.rivets.diameter_mm / 2
        low, high = (start + edge, turn) if middle <= turn else (turn, end - edge)
        past = max(low - sleeve.start_mm, sleeve.end_mm - high)
        if sleeve.length_mm > half + _ROUNDOFF_MM:
            message = f"{name}: a compressed sleeve is longer than half of its segment"
            yield _on_axis(beam, middle, "sleeve-length", message, (sleeve.length_mm, half))
        elif past > _ROUNDOFF_MM:
            message = f"{name}: a sleeve lies over a rivet hole or past its half of a segment"
            yield _on_axis(beam, middle, "sleeve-place", message, (past, 0.0))


def _segment_mm(beam: Beam, place_mm: float) -> tuple[float, float]:
    """Find the segment that holds a place, or is nearest to it."""
    return min(
        beam.rivets.segments_mm,
        key=lambda segment: max(segment[0] - place_mm, place_mm - segment[1]),
    )


def _on_axis(
    beam: Beam, place_mm: float, rule: str, message: str, found: tuple[float, float]
) -> Violation:
    """Give a fault at a place on the axis, with what was found and what is allowed."""
    x_mm = place_mm - beam.length_mm / 2
    return Violation(rule, message, x_mm, 0.0, actual=found[0], allowed=found[1])
