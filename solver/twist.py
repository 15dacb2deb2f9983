"""Twist of a wire whose closed loop writhes.

The ends of a closed wire fix its linking number Lk = Tw + Wr. One that was laid flat without twist
has Lk = 0, so that it is twisted by Tw = −Wr turns when its loop writhes. A straight round wire
spreads them evenly along its length 2π, which costs 2π β ρ Wr² where bending costs β ∮ κ² dl: ρ is
its stiffness GJ against twist over EI = 2β.

The writhe is a double integral, but its change is a single one (Fuller, Proc. Natl. Acad. Sci. USA
75 (1978) 3557): from the flat loop, whose writhe is 0,

    Wr = (1/2π) ∮ (t0 × t)·(t0' + t')/(1 + t0·t) dθ,

as long as no tangent t has come to point against its own t0 on the way. By the unknowns it changes
as the tangent's image on the sphere sweeps area, ∂Wr = (1/2π) ∮ (x'' × x')·∂x' / |x'|³ dθ.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.float64]


def _unit_tangent(edge: Vectors) -> tuple[Vectors, Vectors]:
    """Unit tangent t (Q, 3) of a curve with x', x'' (Q, 6), and its derivative by θ."""
    tangent, second = edge[:, :3], edge[:, 3:]
    length = np.linalg.norm(tangent, axis=1, keepdims=True)
    unit = tangent / length
    return unit, (second - unit * np.sum(unit * second, axis=1, keepdims=True)) / length


def writhe_since(laid: Vectors, edge: Vectors, arc: Vectors) -> float:
    """Writhe of a closed curve above that of the curve from which it was deformed.

    Parameters
    ----------
    laid, edge : array (Q, 6)
        x' and x'' of the two at the same Q angles.
    arc : array (Q,)
        Weights dθ.
    """
    t0, turn0 = _unit_tangent(laid)
    t, turn = _unit_tangent(edge)
    swept = np.sum(np.cross(t0, t) * (turn0 + turn), axis=1) / (1 + np.sum(t0 * t, axis=1))
    return float(swept @ arc) / (2 * np.pi)


def writhe_slope(edge: Vectors, arc: Vectors, edge_map: Vectors) -> Vectors:
    """Derivatives (n,) of a closed curve's writhe by unknowns q with ``edge = edge_map @ q``.

    Parameters
    ----------
    edge : array (Q, 6)
        x' and x'' at Q angles.
    arc : array (Q,)
        Weights dθ.
    edge_map : array (Q, 6, n)
    """
    normal = _turn_of_tangent(edge) * (arc / (2 * np.pi))[:, None]
    return normal.ravel() @ edge_map[:, :3].reshape(-1, edge_map.shape[-1])


def writhe_curvature(edge: Vectors, arc: Vectors, edge_map: Vectors) -> Vectors:
    """Second derivatives (n, n) of a closed curve's writhe, with arguments as of the first.

    Of the slope's own derivative the part is left out that integrates to 0 round the loop: it is
    antisymmetric in the two unknowns.
    """
    n = edge_map.shape[-1]
    tangent, first = edge[:, :3], edge_map[:, :3]
    square = np.sum(tangent * tangent, axis=1)
    weight = arc / (2 * np.pi)
    # ∂x'' × x', and −3 (x'' × x') (x'·∂x') / |x'|²
    rows = np.cross(edge_map[:, 3:], tangent[:, :, None], axis=1)
    rows *= (weight * square**-1.5)[:, None, None]
    longer = np.einsum("qa,qan->qn", tangent, first) * (3 * weight / square)[:, None]
    rows -= _turn_of_tangent(edge)[:, :, None] * longer[:, None, :]
    half = first.reshape(-1, n).T @ rows.reshape(-1, n) / 2
    return half + half.T


def _turn_of_tangent(edge: Vectors) -> Vectors:
    """(x'' × x')/|x'|³, (Q, 3)."""
    tangent, second = edge[:, :3], edge[:, 3:]
    return np.cross(second, tangent) / np.linalg.norm(tangent, axis=1, keepdims=True) ** 3


@dataclass(frozen=True)
class WireTwist:
    """A round wire that was laid flat without twist, of the energy of docs/theory.md, eq. (9).

    Attributes
    ----------
    stiffness : float
        2π β ρ: energy of one turn of twist, units of E_f t R².
    laid : array (Q, 6)
        x' and x'' of the flat loop at Q angles.
    """

    stiffness: float
    laid: Vectors

    def writhe(self, edge: Vectors, arc: Vectors) -> float:
        """Writhe of a loop with x' and x'' (Q, 6) and weights dθ (Q,)."""
        return writhe_since(self.laid, edge, arc)

    def energy(self, edge: Vectors, arc: Vectors) -> float:
        """Energy of the twist that the writhe of a loop leaves to its wire."""
        return self.stiffness * self.writhe(edge, arc) ** 2

    def derivatives(
        self, edge: Vectors, arc: Vectors, edge_map: Vectors
    ) -> tuple[float, Vectors, Vectors]:
        """Energy, gradient (n,) and Hessian (n, n) in unknowns q with ``edge = edge_map @ q``.

        Parameters
        ----------
        edge : array (Q, 6)
            x' and x'' at Q angles.
        arc : array (Q,)
            Weights dθ.
        edge_map : array (Q, 6, n)
        """
        turns, slope = self.writhe(edge, arc), writhe_slope(edge, arc, edge_map)
        twice = 2 * self.stiffness
        hessian = twice * np.outer(slope, slope)
        hessian += twice * turns * writhe_curvature(edge, arc, edge_map)
        return self.stiffness * turns**2, twice * turns * slope, hessian


def flat_wire_twist(
    beta: float, ratio: float, semi_axes: tuple[float, float], angle: Vectors
) -> WireTwist:
    """Twist of a wire laid as an ellipse, at angles (Q,) of the disc's edge.

    ``ratio`` is ρ = GJ/EI.
    """
    along, across = semi_axes
    cosine, sine, level = np.cos(angle), np.sin(angle), np.zeros_like(angle)
    laid = [-along * sine, across * cosine, level, -along * cosine, -across * sine, level]
    return WireTwist(2 * math.pi * beta * ratio, np.stack(laid, axis=1))
