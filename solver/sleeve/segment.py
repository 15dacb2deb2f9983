"""A segment of beam between two rivets, with a sleeve on both faces of one of its halves."""

from __future__ import annotations

from dataclasses import dataclass

from solver.errors import SceneError
from solver.omitted import OmittedTerm
from solver.sleeve.couple import SleeveCouple, sleeve_couple
from solver.sleeve.omissions import left_out
from solver.sleeve.pressed import free_pitch_m
from solver.sleeve.scene import BeamSegment
from solver.strip.snap import Bistable, Snap, solve_strip
from solver.strip.state import Side


@dataclass(frozen=True)
class SegmentPrediction:
    """What a segment does, in SI units.

    State + is arched up. Its lower sleeve, on the concave side, is the one that is heated; that of
    state − is the upper one, and all is mirrored.

    Attributes
    ----------
    segment : BeamSegment
    free_pitch_m : float
        Of the cold row when nothing holds it.
    cold, hot : SleeveCouple
        One sleeve on the straight beam.
    rest : Bistable
        Both sleeves cold.
    heated : Bistable
        The lower sleeve hot, the upper one cold.
    omitted : tuple of OmittedTerm
    """

    segment: BeamSegment
    free_pitch_m: float
    cold: SleeveCouple
    hot: SleeveCouple
    rest: Bistable
    heated: Bistable
    omitted: tuple[OmittedTerm, ...]

    @property
    def barrier_J(self) -> float | None:  # noqa: N802 - the unit's name
        """Energy from either state up to the saddle between them, both sleeves cold."""
        return self.rest.barrier_J(Side.UP)

    @property
    def couple_N_m(self) -> float:  # noqa: N802
        """Couple of the hot sleeve less that of the cold one."""
        return self.heated.scene.couple_N_m

    @property
    def snap(self) -> Snap | None:
        """How a growing couple snaps state + while the lower sleeve is hot, if any does."""
        return self.heated.pushed.get(Side.UP)

    @property
    def critical_couple_N_m(self) -> float | None:  # noqa: N802
        """Couple that snaps state + while the lower sleeve is hot."""
        return self.snap.critical_couple_N_m if self.snap else None

    @property
    def snaps(self) -> bool:
        """Whether heating one side snaps the segment."""
        return self.heated.snaps(Side.UP)

    @property
    def margin(self) -> float | None:
        """Couple over critical couple; greater than 1 where heating one side snaps it."""
        return self.snap.margin(self.couple_N_m) + 1 if self.snap else None

    @property
    def released_J(self) -> float | None:  # noqa: N802
        """Energy set free in the snap, at the critical couple."""
        return self.snap.released_J if self.snap else None


def predict_segment(segment: BeamSegment) -> SegmentPrediction:
    """Solve the sleeves cold and hot, and the beam between them.

    Raises
    ------
    SceneError
        When the sleeves would not be compressed, the beam is too wide for the loops, or a number is
        out of range.
    NotConvergedError
        When a loop or the beam has no shape to rely on.
    """
    free = free_pitch_m(segment.cell)
    if segment.pitch_m >= free:
        raise SceneError(
            f"the sleeve is not compressed: {segment.loops} loops on "
            f"{segment.loops * segment.pitch_m * 1e3:.4g} mm stand {segment.pitch_m * 1e3:.4g} mm "
            f"apart, and {free * 1e3:.4g} mm when free; take more loops or a shorter sleeve"
        )
    seat = segment.seat
    cold = sleeve_couple(segment.cell, seat, segment.pitch_m)
    warm = segment.cell.with_wire_modulus(segment.hot_modulus_Pa)
    hot = sleeve_couple(warm, seat, segment.pitch_m, start=cold.pressed)
    rest, heated = (solve_strip(segment.loaded(below, cold)) for below in (cold, hot))
    return SegmentPrediction(
        segment=segment,
        free_pitch_m=free,
        cold=cold,
        hot=hot,
        rest=rest,
        heated=heated,
        omitted=left_out(segment, cold, hot, rest, heated),
    )
