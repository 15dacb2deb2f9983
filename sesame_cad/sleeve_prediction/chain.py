"""The plane curve of a chain of segments, each in one of its states."""

from __future__ import annotations

import json
from dataclasses import dataclass
from math import degrees

import numpy as np
from numpy.typing import NDArray

from sesame_cad.errors import InputError
from sesame_cad.sleeve_prediction.segment import predict_sleeve
from sesame_cad.specification import Specification
from solver.strip.chain import chain

Vectors = NDArray[np.float64]

LONGEST_CHAIN = 1000
"""Segments; more have no place on a drawing."""


@dataclass(frozen=True)
class ChainCurve:
    """A chain that begins at the origin; its first segment's chord is the x-axis.

    Attributes
    ----------
    states : str
        Of each segment in turn, such as ``"++-+"``.
    segments_mm : array (segments, points, 2)
        Points of each segment from rivet to rivet.
    """

    states: str
    segments_mm: Vectors

    @property
    def rivets_mm(self) -> Vectors:
        """Where the rivets lie (segments + 1, 2)."""
        return np.vstack([self.segments_mm[0, :1], self.segments_mm[:, -1]])

    @property
    def turn_deg(self) -> float:
        """Angle from the first segment's chord to the last one's, counter-clockwise."""
        chords = np.diff(self.rivets_mm, axis=0)
        direction = np.unwrap(np.arctan2(chords[:, 1], chords[:, 0]))
        return degrees(direction[-1] - direction[0])


def chain_curve(spec: Specification, states: str) -> ChainCurve:
    """Predict the curve of a chain of a specification's segments, all sleeves cold.

    Raises
    ------
    InputError
        When a state is none, or the specification has no sleeves that work.
    NotConvergedError
        When there is no shape to rely on.
    """
    wrong = sorted(set(states) - {"+", "-"})
    if wrong or not 0 < len(states) <= LONGEST_CHAIN:
        raise InputError(
            f"--states: {states[:40]!r} must be 1 to {LONGEST_CHAIN} signs, each + or -, "
            "such as ++-+"
        )
    rest = predict_sleeve(spec).rest
    return ChainCurve(states, 1e3 * chain(states, rest.unloaded))


def chain_csv(curve: ChainCurve) -> str:
    """Write a line a point."""
    lines = ["segment,state,x_mm,y_mm"]
    for number, (state, points) in enumerate(zip(curve.states, curve.segments_mm, strict=True), 1):
        rounded = np.round(points, 4) + 0.0
        lines += [f"{number},{state},{x:.4f},{y:.4f}" for x, y in rounded]
    return "\n".join(lines) + "\n"


def chain_json(curve: ChainCurve) -> str:
    """Write states, rivets and points."""
    data = {
        "states": curve.states,
        "turn_deg": round(curve.turn_deg, 4),
        "rivets_mm": (np.round(curve.rivets_mm, 4) + 0.0).tolist(),
        "segments_mm": (np.round(curve.segments_mm, 4) + 0.0).tolist(),
    }
    return json.dumps(data, indent=2) + "\n"
