"""Area of triangles with its first three derivatives.

A = |n|/2 with n = p × q, p and q being the sides from the first corner. n is bilinear in them, so
that its second derivatives are constant and its third ones vanish.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.float64]

_FROM_SIDES = np.kron(np.array([[-1.0, 1.0, 0.0], [-1.0, 0.0, 1.0]]), np.eye(3))
"""The two sides (6) from the three corners (9)."""


def _cross_matrix(v: Vectors) -> Vectors:
    """Matrices (m, 3, 3) of v × · for vectors (m, 3)."""
    out = np.zeros((len(v), 3, 3))
    out[:, 0, 1], out[:, 0, 2], out[:, 1, 2] = -v[:, 2], v[:, 1], -v[:, 0]
    return out - np.swapaxes(out, 1, 2)


@dataclass(frozen=True, eq=False)
class CornerArea:
    """Triangles with corners (m, 3, 3)."""

    corners: Vectors

    @cached_property
    def _sides(self) -> tuple[Vectors, Vectors]:
        return self.corners[:, 1] - self.corners[:, 0], self.corners[:, 2] - self.corners[:, 0]

    @cached_property
    def _normal(self) -> tuple[Vectors, Vectors]:
        """|n| (m,) and n/|n| (m, 3)."""
        normal = np.cross(*self._sides)
        length = np.linalg.norm(normal, axis=1)
        return length, normal / length[:, None]

    @cached_property
    def _normal_slope(self) -> Vectors:
        """∂n/∂(p, q), (m, 3, 6)."""
        return _normal_by_sides(*self._sides)

    @cached_property
    def _across(self) -> Vectors:
        """Matrices (m, 3, 3) that leave out what lies along n."""
        unit = self._normal[1]
        return np.eye(3) - unit[:, :, None] * unit[:, None, :]

    @property
    def area(self) -> Vectors:
        """A, (m,)."""
        return self._normal[0] / 2

    def gradient(self) -> Vectors:
        """Derivative (m, 9) by the corners."""
        return (self._normal[1][:, None, :] @ self._normal_slope)[:, 0] / 2 @ _FROM_SIDES

    def hessian(self) -> Vectors:
        """Second derivatives (m, 9, 9) by the corners."""
        length, unit = self._normal
        slope = self._normal_slope
        by_sides = np.swapaxes(slope, 1, 2) @ self._across @ slope / length[:, None, None]
        by_sides += second_of_cross(unit)
        return _FROM_SIDES.T @ by_sides @ _FROM_SIDES / 2

    def hessian_change(self, motion: Vectors) -> Vectors:
        """Rate (m, 9, 9) of the second derivatives as the first corner moves at (m, 3)."""
        length, unit = self._normal
        slope, across = self._normal_slope, self._across
        rate = _normal_by_sides(-motion, -motion)
        moving = (slope @ np.concatenate([-motion, -motion], axis=1)[:, :, None])[:, :, 0]
        growth = np.sum(unit * moving, axis=1) / length
        turn = (across @ moving[:, :, None])[:, :, 0] / length[:, None]
        tilt = turn[:, :, None] * unit[:, None, :]
        mixed = np.swapaxes(rate, 1, 2) @ across @ slope
        changed = -growth[:, None, None] * across - tilt - np.swapaxes(tilt, 1, 2)
        by_sides = mixed + np.swapaxes(mixed, 1, 2) + np.swapaxes(slope, 1, 2) @ changed @ slope
        by_sides = by_sides / length[:, None, None] + second_of_cross(turn)
        return _FROM_SIDES.T @ by_sides @ _FROM_SIDES / 2


def _normal_by_sides(p: Vectors, q: Vectors) -> Vectors:
    """Derivative (m, 3, 6) of p × q."""
    return np.concatenate([-_cross_matrix(q), _cross_matrix(p)], axis=2)


def second_of_cross(v: Vectors) -> Vectors:
    """Second derivatives (m, 6, 6) of v·(p × q) by p and q."""
    out = np.zeros((len(v), 6, 6))
    out[:, 3:, :3] = _cross_matrix(v)
    out[:, :3, 3:] = -out[:, 3:, :3]
    return out
