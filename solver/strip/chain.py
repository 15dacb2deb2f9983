"""The curve of a chain of strips, each in one of its stable states.

A rivet goes through the faces of both strips that it joins and presses them together, so that
joined ends share their tangent. With pinned ends no moment acts at an end, so none acts between
neighbours either: each keeps the shape that it has alone, and a chain that hangs on its first rivet
is in balance in any combination of states. That neighbours may touch, and the overlap of the strips
at a rivet, are left out.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.errors import SceneError
from solver.strip.state import Side, StripState

Vectors = NDArray[np.float64]


def _turned(points: Vectors, angle: float) -> Vectors:
    c, s = np.cos(angle), np.sin(angle)
    return points @ np.array([[c, s], [-s, c]])


def chain(states: str, shapes: dict[Side, StripState]) -> Vectors:
    """Points (n segments, points of a shape, 2) in m of a chain.

    The first segment lies as it does alone: from 0 to its second rivet on the x-axis.

    Parameters
    ----------
    states : str
        Of each segment in turn, such as ``"++-+"``.
    shapes : dict
        The states' shapes, as `solver.strip.snap.Bistable` gives them.

    Raises
    ------
    SceneError
        When a state is none, or has no shape.
    """
    allowed = [side.value for side in (Side.UP, Side.DOWN) if side in shapes]
    wrong = sorted(set(states) - set(allowed))
    if wrong or not states:
        raise SceneError(f"states = {states!r}: must be one or more of {' and '.join(allowed)}")
    end, heading = np.zeros(2), float(shapes[Side(states[0])].headings_rad[0])
    segments: list[Vectors] = []
    for letter in states:
        shape = shapes[Side(letter)]
        turn = heading - float(shape.headings_rad[0])
        points = end + _turned(shape.points_m, turn)
        segments.append(points)
        end, heading = points[-1], float(shape.headings_rad[-1]) + turn
    return np.array(segments)
