"""Heights and stresses of a solved mesh."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solver.mesh.triangulation import Wire

Vectors = NDArray[np.float64]


def area_vector(loop: Vectors) -> Vectors:
    """½ ∮ x × dx of a closed chain of positions (n, 3): its axis stays the shape's when turned.

    For a saddle with two mirror planes it is the line in which they meet.
    """
    arms = loop - loop.mean(axis=0)
    return np.cross(arms, np.roll(arms, -1, axis=0)).sum(axis=0) / 2


def _top(values: Vectors) -> float:
    """Largest value of a closed chain, by the parabola through its largest three in a row."""
    k = int(np.argmax(values))
    before, at, after = values[k - 1], values[k], values[(k + 1) % len(values)]
    bend = 2 * at - before - after
    return float(at if bend <= 0 else at + (after - before) ** 2 / (8 * bend))


def rise(loop: Vectors, axis: Vectors) -> float:
    """Extent of a closed chain of positions (n, 3) along an axis (3,)."""
    values = loop @ (axis / np.linalg.norm(axis))
    return _top(values) + _top(-values)


def loop_heights(positions: Vectors, wires: tuple[Wire, ...]) -> Vectors:
    """Height (w,) of each closed wire along its own axis, units of R."""
    loops = [positions[wire.vertices] for wire in wires]
    return np.array([rise(loop, area_vector(loop)) for loop in loops])


def total_height(positions: Vectors, wires: tuple[Wire, ...]) -> float:
    """Extent of all closed wires together along the axis of all, units of R."""
    loops = [positions[wire.vertices] for wire in wires]
    axis = np.sum([area_vector(loop) for loop in loops], axis=0)
    axis = axis / np.linalg.norm(axis)
    tops = [_top(loop @ axis) for loop in loops]
    bottoms = [_top(-(loop @ axis)) for loop in loops]
    return max(tops) + max(bottoms)
