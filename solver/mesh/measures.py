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
    """Largest value of a chain, by the parabola through its largest three in a row.

    The last is next to the first.
    """
    k = int(np.argmax(values))
    before, at, after = values[k - 1], values[k], values[(k + 1) % len(values)]
    bend = 2 * at - before - after
    return float(at if bend <= 0 else at + (after - before) ** 2 / (8 * bend))


def rise(loop: Vectors, axis: Vectors) -> float:
    """Extent of a closed chain of positions (n, 3) along an axis (3,)."""
    values = loop @ (axis / np.linalg.norm(axis))
    return _top(values) + _top(-values)


def bow(wire: Vectors) -> float:
    """Largest distance of a chain of positions (n, 3) from the line between its ends."""
    along = wire[-1] - wire[0]
    arms = wire - wire[0]
    length = float(np.linalg.norm(along))
    if length == 0:
        return float(np.linalg.norm(arms, axis=1).max())
    return float(np.linalg.norm(np.cross(arms, along / length), axis=1).max())


def loop_heights(positions: Vectors, wires: tuple[Wire, ...]) -> Vectors:
    """Height (w,) of each closed wire along its own axis, and bow of each open one; units of R."""
    chains = [(positions[wire.vertices], wire.closed) for wire in wires]
    return np.array(
        [rise(chain, area_vector(chain)) if closed else bow(chain) for chain, closed in chains]
    )


def common_axis(positions: Vectors, wires: tuple[Wire, ...]) -> Vectors:
    """Unit axis (3,) of all closed wires; without any, that of least extent."""
    loops = [positions[wire.vertices] for wire in wires if wire.closed]
    if loops:
        total = np.sum([area_vector(loop) for loop in loops], axis=0)
        return total / np.linalg.norm(total)
    everything = np.concatenate([positions[wire.vertices] for wire in wires])
    return np.linalg.svd(everything - everything.mean(axis=0))[2][-1]


def total_height(positions: Vectors, wires: tuple[Wire, ...]) -> float:
    """Extent of all wires together along the axis of the closed ones, units of R."""
    axis = common_axis(positions, wires)
    chains = [(positions[wire.vertices] @ axis, wire.closed) for wire in wires]
    tops = [_top(along) if closed else float(along.max()) for along, closed in chains]
    bottoms = [_top(-along) if closed else float((-along).max()) for along, closed in chains]
    return max(tops) + max(bottoms)
