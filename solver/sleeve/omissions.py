"""What the prediction of a segment leaves out, with the size of each."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from solver.held_account import TILT
from solver.omitted import OmittedTerm
from solver.sleeve.couple import SleeveCouple, couple_on_curve
from solver.sleeve.scene import BeamSegment
from solver.strip.omissions import GRAVITY_M_S2
from solver.strip.snap import Bistable, solve_strip
from solver.strip.state import Side, StripState

_LITTLE = 0.01
_MUCH = 0.1


def covered_curvature(state: StripState, covered: tuple[float, float]) -> float:
    """Largest curvature, per m, of the part that the sleeves cover."""
    place = np.linspace(0, 1, len(state.curvatures_per_m))
    inside = (place >= covered[0]) & (place <= covered[1])
    return float(np.abs(state.curvatures_per_m[inside]).max())


def curved_share(
    segment: BeamSegment, cold: SleeveCouple, hot: SleeveCouple, heated: Bistable
) -> float:
    """Net couple's error by its linear fall with the curvature, over the critical couple.

    At the largest curvature of state +, hot sleeve on the concave side.
    """
    state = heated.unloaded[Side.UP]
    curvature = covered_curvature(state, segment.strip.covered)
    net = couple_on_curve(hot, segment.seat, -curvature)
    net -= couple_on_curve(cold, segment.seat, curvature)
    added = hot.bending_stiffness_N_m2 + cold.bending_stiffness_N_m2
    linear = hot.couple_N_m - cold.couple_N_m + added * curvature
    return abs(net - linear) / _critical(heated)


def ends_share(segment: BeamSegment, heated: Bistable) -> float:
    """Change of the critical couple if each end's couple builds up over half a pitch.

    A couple that rises evenly over half a pitch does what a whole one does that begins halfway.
    """
    begin, end = segment.strip.covered
    less = (end - begin) / segment.loops / 4
    shorter = replace(
        heated.scene,
        covered=(begin + less, end - less),
        couple_bottom_N_m=0.0,
        couple_top_N_m=0.0,
    )
    return abs(_critical(solve_strip(shorter)) / _critical(heated) - 1)


def constraint_share(segment: BeamSegment, rest: Bistable) -> float:
    """Energy of the shorter strip, bent by the beam's end slopes, over the beam's.

    Rivets that press both strips' faces together would give the shorter one, which is pulled by P,
    the beam's slopes at its ends: in even parts s = ±(α0 - α1)/2 and in odd parts r = (α0 + α1)/2.
    A tie bar of length c has EI λ (s² coth h + r²/(coth h - 1/h)) then, with λ² = P/EI, h = λ c/2
    (from d⁴z/dx⁴ = λ² d²z/dx² with those slopes and no height at the ends; small slopes).
    """
    state, strip = rest.unloaded[Side.UP], segment.strip
    second = segment.constraint_width_m * segment.constraint_thickness_m**3 / 12
    stiffness = strip.modulus_Pa * second
    first, last = (float(state.headings_rad[k]) for k in (0, -1))
    rate = math.sqrt(abs(state.force_N) / stiffness)
    half = rate * strip.constraint_m / 2
    coth = 1 / math.tanh(half)
    even, odd = (first - last) ** 2 / 4 * coth, (first + last) ** 2 / 4 / (coth - 1 / half)
    return stiffness * rate * (even + odd) / state.bending_J


def tie_rise_share(segment: BeamSegment, cold: SleeveCouple, hot: SleeveCouple) -> float:
    """Rise of the wire from the valleys to the ties, over the couple's arm; the larger of both.

    The loops are solved as if they were held at their valleys alone.
    """
    angle = np.pi / 2 + np.array([0.0, segment.tie_angle_rad])
    shares: list[float] = []
    for couple in (cold, hot):
        valley, tie = couple.pressed.points_m(np.ones(2), angle)[:, 2]
        shares.append(float(tie - valley) / couple.arm_m)
    return max(shares)


def _critical(found: Bistable) -> float:
    snap = found.pushed.get(Side.UP)
    return snap.critical_couple_N_m if snap else found.scene.largest_couple_N_m


def _sleeves_weight_share(segment: BeamSegment, state: StripState) -> float:
    weight = segment.sleeves_kg * GRAVITY_M_S2
    return weight * float(np.abs(state.points_m[:, 1]).max()) / state.bending_J


def _of_loops(cold: SleeveCouple, hot: SleeveCouple) -> list[OmittedTerm]:
    """What the loops' own solves leave out and warn of; ties keep loops from tilting."""
    told: dict[str, OmittedTerm] = {}
    for couple in (cold, hot):
        for term in couple.pressed.held.omitted:
            if term.matters and term.term != TILT:
                told.setdefault(term.term, term)
    return list(told.values())


def left_out(
    segment: BeamSegment,
    cold: SleeveCouple,
    hot: SleeveCouple,
    rest: Bistable,
    heated: Bistable,
) -> tuple[OmittedTerm, ...]:
    """List what is left out of a segment, its beam and its sleeves."""
    curved, ends = curved_share(segment, cold, hot, heated), ends_share(segment, heated)
    tie = constraint_share(segment, rest)
    weight = _sleeves_weight_share(segment, rest.unloaded[Side.UP])
    rise = tie_rise_share(segment, cold, hot)
    terms = [
        OmittedTerm(
            "couples that do not fall evenly with the beam's curvature",
            "error of the net couple / critical couple",
            curved,
            matters=curved > _MUCH,
        ),
        OmittedTerm(
            "the couple builds up over half a loop at the sleeves' ends",
            "change of the critical couple",
            ends,
            matters=ends > _MUCH,
        ),
        OmittedTerm(
            "bending of the constraint, if its rivets stop the beam's ends from turning on it",
            "its energy / the beam's bending energy",
            tie,
            matters=tie > _LITTLE,
        ),
        OmittedTerm(
            "weight of the sleeves",
            "work of the weight over the beam's rise / bending energy",
            weight,
            matters=weight > _LITTLE,
        ),
        OmittedTerm(
            "ties beside the valleys, which hold the wire down there too",
            "rise of the free wire at the ties / the couple's arm",
            rise,
            matters=rise > _MUCH,
        ),
    ]
    stripe = segment.cell.stripe_m
    if stripe is not None:
        longest = max(couple.pressed.stripe_path_m for couple in (cold, hot)) / stripe
        terms.append(
            OmittedTerm(
                "stripe along the arched fabric instead of straight",
                "length of the fabric's line under it / its length",
                longest,
                matters=longest > 1,
            )
        )
    return (*rest.omitted, *terms, *_of_loops(cold, hot))
