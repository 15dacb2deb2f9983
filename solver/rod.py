"""Energy of the wire: bending by its curvature, and a stiff stretch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.float64]

_STRAIGHT = 1e-12
"""Least sin² of the angle from x' to x'' where the wire's own curvature asks for a direction."""

_METRIC = np.array([[0, 2], [2, 1]])
_METRIC_FACTOR = np.array([[2.0, 1.0], [1.0, 2.0]])
"""2 f_a on x'·x', 2 f_b on x''·x'' and f_c on x'·x'', of slopes listed as (f_a, f_b, f_c)."""


@dataclass(frozen=True)
class Rod:
    """A wire along a curve x(θ) whose length is ``speed`` dθ when it is not stretched.

    Bending energy β ∮ (κ − κ0)² dl and stretch energy (k/2) ∮ (λ − 1)² ds, λ = |x'|/speed. The wire
    is free to turn about its own axis, so that its natural curvature κ0 points where κ does.
    κ is the exact curvature of the curve: docs/theory.md, eq. (8).

    Numbers may be arrays (B, 1), one for each of many wires.
    """

    beta: float | Vectors
    axial_stiffness: float | Vectors
    natural_curvature: float = 0.0

    def energies(
        self, tangent: Vectors, second: Vectors, arc: Vectors, speed: Vectors | float = 1.0
    ) -> tuple[float, float]:
        """Bending and stretch energy of points with x', x'' (Q, 3) and weights dθ (Q,)."""
        a, b, c = _invariants(tangent, second)
        kappa = np.sqrt(np.maximum(a * b - c * c, 0) / a**3)
        root = np.sqrt(a)
        bending = self.beta * (kappa - self.natural_curvature) ** 2 * root
        stretch = self.axial_stiffness / 2 * (root / speed - 1) ** 2 * speed
        return float(bending @ arc), float(stretch @ arc)

    def derivatives(
        self,
        edge: Vectors,
        arc: Vectors,
        edge_map: Vectors,
        speed: Vectors | float = 1.0,
        force: Vectors | None = None,
    ) -> tuple[Vectors, Vectors, Vectors]:
        """Energy, gradient (…, n) and Hessian (…, n, n) in unknowns q with ``edge = edge_map @ q``.

        Parameters
        ----------
        edge_map : array (Q, 6, n)
        edge, arc, speed, force
            As of `along`.
        """
        value, slope, curvature = self.along(edge, arc, speed, force)
        gradient = slope.reshape(*edge.shape[:-2], -1) @ edge_map.reshape(-1, edge_map.shape[-1])
        return value, gradient, by_unknowns(curvature, edge_map)

    def along(
        self,
        edge: Vectors,
        arc: Vectors,
        speed: Vectors | float = 1.0,
        force: Vectors | None = None,
    ) -> tuple[Vectors, Vectors, Vectors]:
        """Energy, its slope (…, Q, 6) and curvature (…, Q, 6, 6) by x' and x'' at each point.

        Parameters
        ----------
        edge : array (…, Q, 6)
            x' and x'' at Q points.
        arc : array (Q,)
            Weights dθ.
        speed : array (Q,), optional
            Length of wire per θ.
        force : array (…, Q), optional
            The wire's tension as the curvature is to take it, instead of that of the stretch.
        """
        pair = edge.reshape(*edge.shape[:-1], 2, 3)
        gram = pair @ np.swapaxes(pair, -1, -2)
        a, b, c = gram[..., 0, 0], gram[..., 1, 1], gram[..., 0, 1]
        value, slope, curvature = self._bending(a, b, c)
        stretch, by_a, tension = self._stretch(a, speed)
        slope[..., 0] += by_a
        slope *= arc[:, None]
        turn = slope[..., _METRIC] * _METRIC_FACTOR
        pull = (turn @ pair).reshape(edge.shape)
        if force is not None:
            turn[..., 0, 0] += arc * (force - tension) / np.sqrt(a)
            tension = force
        curvature[..., 0, 0] += (self.axial_stiffness / speed - tension / np.sqrt(a)) / (4 * a)
        curvature *= arc[:, None, None]
        # slopes of a, b and c by x' and x''
        rows = np.zeros((*edge.shape[:-1], 3, 6))
        rows[..., 0, :3] = 2 * edge[..., :3]
        rows[..., 1, 3:] = 2 * edge[..., 3:]
        rows[..., 2, :3], rows[..., 2, 3:] = edge[..., 3:], edge[..., :3]
        bent = np.swapaxes(rows, -1, -2) @ (curvature @ rows)
        # and their second derivatives
        for axis in range(3):
            bent[..., axis::3, axis::3] += turn
        return (value + stretch) @ arc, pull, bent

    def _stretch(self, a: Vectors, speed: Vectors | float) -> tuple[Vectors, Vectors, Vectors]:
        """(k/2)(√a/speed − 1)² speed, its slope by a, and the tension k (√a/speed − 1)."""
        root = np.sqrt(a)
        excess = root / speed - 1
        tension = self.axial_stiffness * excess
        return tension * excess * speed / 2, tension / (2 * root), tension

    def force_ahead(
        self, tangent: Vectors, change: Vectors, speed: Vectors | float = 1.0
    ) -> Vectors:
        """Tension (…, Q) of a wire with x' (…, Q, 3), to first order in a change of x'."""
        length = np.sqrt(_dot(tangent, tangent))
        longer = _dot(tangent, change) / length
        return self.axial_stiffness * ((length + longer) / speed - 1)

    def _bending(self, a: Vectors, b: Vectors, c: Vectors) -> tuple[Vectors, Vectors, Vectors]:
        """β (κ − κ0)² dl/dθ, κ² dl/dθ = (a b − c²) a^(−5/2), with its slope and curvature.

        Derivatives (…, 3) and (…, 3, 3) are by a = x'·x', b = x''·x'' and c = x'·x''.
        """
        slope, curvature = np.empty((*a.shape, 3)), np.zeros((*a.shape, 3, 3))
        bp = self.beta * a**-2.5
        over, along = bp / a, c * c / a
        slope[..., 0] = bp * (2.5 * along - 1.5 * b)
        slope[..., 1] = bp * a
        mixed = np.multiply(bp, -2 * c, out=slope[..., 2])
        curvature[..., 0, 0] = over * (3.75 * b - 8.75 * along)
        curvature[..., 0, 1] = curvature[..., 1, 0] = -1.5 * bp
        curvature[..., 0, 2] = curvature[..., 2, 0] = -2.5 * mixed / a
        curvature[..., 2, 2] = -2 * bp
        value = bp * (a * b - c * c)
        if self.natural_curvature == 0:
            return value, slope, curvature
        own = self._natural(a, b, c)
        return value + own[0], slope + own[1], curvature + own[2]

    def _natural(self, a: Vectors, b: Vectors, c: Vectors) -> tuple[Vectors, Vectors, Vectors]:
        """β (κ0² √a − 2 κ0 h/a), h = |x' × x''|, with its slope and curvature by a, b and c."""
        k0, beta = self.natural_curvature, self.beta
        h = np.sqrt(np.maximum(a * b - c * c, _STRAIGHT * a * b))
        zero = np.zeros_like(a)
        d1 = np.stack([b, a, -2 * c], axis=-1) / (2 * h)[..., None]
        d2 = np.zeros((*a.shape, 3, 3))
        d2[..., 0, 1] = d2[..., 1, 0] = 1
        d2[..., 2, 2] = -2
        d2 = (
            d2 / (2 * h)[..., None, None] - d1[..., :, None] * d1[..., None, :] / h[..., None, None]
        )
        along_a = np.stack([np.ones_like(a), zero, zero], axis=-1)
        # derivatives of h/a
        ratio1 = d1 / a[..., None] - (h / a**2)[..., None] * along_a
        mixed = d1[..., :, None] * along_a[..., None, :] / (a**2)[..., None, None]
        both = along_a[..., :, None] * along_a[..., None, :]
        ratio2 = d2 / a[..., None, None] - mixed - np.swapaxes(mixed, -1, -2)
        ratio2 = ratio2 + (2 * h / a**3)[..., None, None] * both
        root = np.sqrt(a)
        value = beta * (k0**2 * root - 2 * k0 * h / a)
        weight = np.asarray(beta)[..., None]
        slope = weight * (k0**2 * (0.5 / root)[..., None] * along_a - 2 * k0 * ratio1)
        bent = k0**2 * (-0.25 / (a * root))[..., None, None] * both - 2 * k0 * ratio2
        return value, slope, weight[..., None] * bent


def by_unknowns(curvature: Vectors, edge_map: Vectors) -> Vectors:
    """Hessian (…, n, n) from that (…, Q, 6, 6) by x' and x'', with a map (Q, 6, n) to these."""
    n = edge_map.shape[-1]
    turned = (curvature @ edge_map).reshape(*curvature.shape[:-3], -1, n)
    return edge_map.reshape(-1, n).T @ turned


def _invariants(tangent: Vectors, second: Vectors) -> tuple[Vectors, Vectors, Vectors]:
    """Give x'·x', x''·x'' and x'·x''."""
    return _dot(tangent, tangent), _dot(second, second), _dot(tangent, second)


def _dot(one: Vectors, other: Vectors) -> Vectors:
    """Scalar products (…,) of vectors (…, 3)."""
    return np.einsum("...a,...a->...", one, other)
