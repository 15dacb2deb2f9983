"""The parts of a segment as they lie in each of its states, in mm."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from patterns.cut_piece import CutPiece
from sesame_cad.sleeve_prediction.bent import BentBeam
from sesame_cad.solids import Surface
from sesame_cad.specification import Specification
from solver.sleeve.couple import SleeveCouple
from solver.sleeve.segment import SegmentPrediction
from solver.strip.state import Side, StripState

Vectors = NDArray[np.float64]

COLD, HOT = "cold", "hot"


@dataclass(frozen=True)
class SleeveRow:
    """A row of loops on the straight beam.

    Attributes
    ----------
    couple : SleeveCouple
    temperature : str
        ``"cold"`` or ``"hot"``.
    upper : bool
        On which face of the beam.
    centres_mm : array (k,)
        Of the loops, along the beam from its first rivet.
    """

    couple: SleeveCouple
    temperature: str
    upper: bool
    centres_mm: Vectors

    def loop(self, radius: Vectors, angle_rad: Vectors) -> Vectors:
        """Points (n, 3) in mm of a loop at the origin of the straight beam."""
        pressed, couple = self.couple.pressed, self.couple
        crest = pressed.points_m(np.ones(1), np.zeros(1))[0, 2]
        points = pressed.points_m(radius, angle_rad)
        points[:, 2] += couple.arm_m - crest
        # the lower row is the upper one turned about the beam's axis
        return points * 1e3 * np.array([1, 1, 1] if self.upper else [1, -1, -1])

    def surfaces(self, beam: BentBeam) -> Iterator[Surface]:
        """Give each loop on a bent beam."""
        for centre in self.centres_mm:

            def surface(radius: Vectors, angle_rad: Vectors, at: float = float(centre)) -> Vectors:
                return beam.carried(self.loop(radius, angle_rad) + np.array([at, 0.0, 0.0]))

            yield surface


@dataclass(frozen=True)
class Assembly:
    """A segment in one state.

    Attributes
    ----------
    name : str
        ``"plus"`` or ``"minus"``.
    state : StripState
    beam : BentBeam
    rows : tuple of SleeveRow
        The upper and the lower one.
    chord_mm : float
        Distance of the rivets.
    """

    name: str
    state: StripState
    beam: BentBeam
    rows: tuple[SleeveRow, SleeveRow]
    chord_mm: float

    @property
    def title(self) -> str:
        """What it shows."""
        upper, lower = (row.temperature for row in self.rows)
        both = "both sleeves cold" if upper == lower else f"lower sleeve {lower}"
        side = "up" if self.state.side is Side.UP else "down"
        return f"{both}: arched {side} by {abs(self.state.height_m) * 1e3:.1f} mm"


def assemblies(spec: Specification, prediction: SegmentPrediction) -> tuple[Assembly, Assembly]:
    """Give state + with cold sleeves, and state − with the lower one hot, which snaps it there."""
    cold, hot = prediction.cold, prediction.hot
    plus = prediction.rest.unloaded[Side.UP]
    minus = prediction.heated.loaded[Side.DOWN]
    segment = prediction.segment
    length_mm, chord_mm = segment.strip.length_m * 1e3, segment.strip.constraint_m * 1e3
    start = spec.sleeve_place.start_mm - spec.beam.hole_end_mm
    pitch_mm = segment.pitch_m * 1e3
    centres = np.array([start + (k + 0.5) * pitch_mm for k in range(segment.loops)])
    upper = SleeveRow(cold, COLD, True, centres)

    def assembly(name: str, state: StripState, lower: SleeveRow) -> Assembly:
        return Assembly(name, state, BentBeam.of_state(state, length_mm), (upper, lower), chord_mm)

    return (
        assembly("plus", plus, SleeveRow(cold, COLD, False, centres)),
        assembly("minus", minus, SleeveRow(hot, HOT, False, centres)),
    )


def beam_piece(spec: Specification) -> CutPiece:
    """Give the beam as it is cut, its first hole at the origin."""
    beam = spec.beam.beam(spec.sleeve_place)
    return beam.piece().moved(beam.length_mm / 2 - spec.beam.hole_end_mm, 0.0)


def constraint_piece(spec: Specification) -> CutPiece:
    """Give the shorter strip as it is cut, its first hole at the origin."""
    strip = spec.constraint
    return strip.piece().moved(strip.length_mm / 2 - spec.beam.hole_end_mm, 0.0)
