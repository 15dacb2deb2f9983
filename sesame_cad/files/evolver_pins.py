"""Pins that hold a shape in a Surface Evolver datafile against drifting and turning.

They are as few as the motions that cost nothing, so that they bear no load and change neither
shape nor energy.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]

AXES = "xyz"
_DIGITS = 12


@dataclass(frozen=True, slots=True)
class Pin:
    """A vertex that stays in a plane: its coordinate along an axis (0, 1, 2) keeps its value."""

    vertex: int
    axis: int
    value: float


def saddle_pins(ring: Indices) -> tuple[Pin, ...]:
    """Pins of a round loop about vertex 0 in the origin, the first of its ring on the x axis.

    They lie in the mirror planes and on the level lines of a saddle with its crests along x.
    """
    eighth = len(ring) // 8
    level = [Pin(int(ring[k * eighth]), 2, 0.0) for k in (1, 3, 5)]
    return (*level, Pin(0, 0, 0.0), Pin(0, 1, 0.0), Pin(int(ring[0]), 1, 0.0))


def wide_pins(positions: Vectors, *, level: bool) -> tuple[Pin, ...]:
    """Pins of any shape: one vertex near its middle, one far off beside it or above.

    Parameters
    ----------
    positions : array (n, 3)
        Where the shape starts.
    level : bool
        Whether three vertices far apart keep their height, too.
    """
    flat = positions[:, :2]
    middle = int(np.argmin(np.linalg.norm(flat - flat.mean(axis=0), axis=1)))
    # one that lies straight beside the middle keeps its line however much the shape shrinks
    arms = np.abs(flat - flat[middle])
    far = int(np.argmax(arms.max(axis=1) - 2 * arms.min(axis=1)))
    across = int(np.argmin(arms[far]))
    places = [(middle, 0), (middle, 1), (far, across)]
    if level:
        places = [*((vertex, 2) for vertex in _wide_triangle(flat)), *places]
    values = np.round(positions, _DIGITS) + 0.0
    return tuple(Pin(vertex, axis, float(values[vertex, axis])) for vertex, axis in places)


def _wide_triangle(flat: Vectors) -> tuple[int, int, int]:
    """Three vertices far apart and off one line."""
    one = int(np.argmax(np.linalg.norm(flat - flat.mean(axis=0), axis=1)))
    other = int(np.argmax(np.linalg.norm(flat - flat[one], axis=1)))
    along, arms = flat[other] - flat[one], flat - flat[one]
    third = int(np.argmax(np.abs(along[0] * arms[:, 1] - along[1] * arms[:, 0])))
    return one, other, third


def numbered(pins: tuple[Pin, ...]) -> tuple[str, dict[int, str]]:
    """Constraints, and the words for each vertex that has any."""
    planes = list(dict.fromkeys((pin.axis, pin.value) for pin in pins))
    formulas = [
        f"constraint {1 + k}\nformula: {AXES[axis]} = {value:.17g}\n"
        for k, (axis, value) in enumerate(planes)
    ]
    numbers: dict[int, list[int]] = {}
    for pin in pins:
        numbers.setdefault(pin.vertex, []).append(1 + planes.index((pin.axis, pin.value)))
    words = {vertex: f"constraint {' '.join(map(str, found))}" for vertex, found in numbers.items()}
    return "".join(formulas), words
