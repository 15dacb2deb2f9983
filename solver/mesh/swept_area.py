"""Area that the tangent of a wire sweeps on the sphere about a pole, with its derivatives.

From one edge u of a wire to the next, v, it is that of the spherical triangle of the pole and the
two tangents (van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125),

    2 atan2(y, x),  y = z·(u × v),  x = |u||v| + |v| z·u + |u| z·v + u·v.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.mesh.corner_area import second_of_cross

Vectors = NDArray[np.float64]


@dataclass(frozen=True)
class SweptArea:
    """Pairs of edges u, v (m, 3), each with its pole (m, 3) of length 1."""

    u: Vectors
    v: Vectors
    pole: Vectors

    def _lengths(self) -> tuple[Vectors, Vectors]:
        return np.linalg.norm(self.u, axis=1), np.linalg.norm(self.v, axis=1)

    def _heights(self) -> tuple[Vectors, Vectors]:
        return np.sum(self.pole * self.u, axis=1), np.sum(self.pole * self.v, axis=1)

    def _x_and_y(self) -> tuple[Vectors, Vectors]:
        (a, b), (up, vp) = self._lengths(), self._heights()
        x = a * b + b * up + a * vp + np.sum(self.u * self.v, axis=1)
        return x, np.sum(self.pole * np.cross(self.u, self.v), axis=1)

    def area(self) -> Vectors:
        """Area (m,), from −2π to 2π, of each pair (docs/theory.md, eq. (16))."""
        x, y = self._x_and_y()
        return 2 * np.arctan2(y, x)

    def derivatives(self) -> tuple[Vectors, Vectors]:
        """Gradient (m, 6) and Hessian (m, 6, 6) by the components of u and v."""
        x, y = self._x_and_y()
        by_x, by_y = self._slopes()
        square = x * x + y * y
        t_x, t_y = -y / square, x / square
        gradient = t_x[:, None] * by_x + t_y[:, None] * by_y
        t_xx, t_xy = 2 * x * y / square**2, (y * y - x * x) / square**2
        xx, yy = (one[:, :, None] * one[:, None, :] for one in (by_x, by_y))
        mixed = by_x[:, :, None] * by_y[:, None, :]
        hessian = t_xx[:, None, None] * (xx - yy)
        hessian += t_xy[:, None, None] * (mixed + np.swapaxes(mixed, 1, 2))
        hessian += t_x[:, None, None] * self._second_of_x()
        hessian += t_y[:, None, None] * second_of_cross(self.pole)
        return 2 * gradient, 2 * hessian

    def _slopes(self) -> tuple[Vectors, Vectors]:
        """∂x and ∂y by u and v, (m, 6) each."""
        (a, b), (up, vp) = self._lengths(), self._heights()
        z, u, v = self.pole, self.u, self.v
        x_by_u = ((b + vp) / a)[:, None] * u + b[:, None] * z + v
        x_by_v = ((a + up) / b)[:, None] * v + a[:, None] * z + u
        by_x = np.concatenate([x_by_u, x_by_v], axis=1)
        return by_x, np.concatenate([np.cross(v, z), np.cross(z, u)], axis=1)

    def _second_of_x(self) -> Vectors:
        """Second derivatives (m, 6, 6) of x by u and v."""
        (a, b), (up, vp) = self._lengths(), self._heights()
        one, other = self.u / a[:, None], self.v / b[:, None]
        out = np.zeros((len(a), 6, 6))
        out[:, :3, :3] = ((b + vp) / a)[:, None, None] * _across(one)
        out[:, 3:, 3:] = ((a + up) / b)[:, None, None] * _across(other)
        mixed = one[:, :, None] * (other + self.pole)[:, None, :] + np.eye(3)
        mixed += self.pole[:, :, None] * other[:, None, :]
        out[:, :3, 3:], out[:, 3:, :3] = mixed, np.swapaxes(mixed, 1, 2)
        return out


def _across(unit: Vectors) -> Vectors:
    return np.eye(3) - unit[:, :, None] * unit[:, None, :]
