"""The smooth shape of a solved loop."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solver.disc_basis import position_map
from solver.disc_functions import DiscFunction
from solver.edge import EdgeCurve
from solver.symmetry import Unknown

Vectors = NDArray[np.float64]
Expansion = dict[tuple[int, DiscFunction], float]
"""Coefficient of each disc function in each component of the position."""


@dataclass(frozen=True)
class LoopShape:
    """Position of every point of the disc, lengths in units of the loop radius.

    The axis of the saddle is z. A circular loop on isotropic fabric has its crests on the x axis
    and its valleys on the y axis, and z = 0 is half-way between.

    Attributes
    ----------
    unknowns : tuple of Unknown
    coefficients : array (n,)
    """

    unknowns: tuple[Unknown, ...]
    coefficients: Vectors

    def position(self, radius: ArrayLike, angle_rad: ArrayLike) -> Vectors:
        """Positions (n, 3) of points of the flat loop.

        They lay at a·radius·cos(angle), b·radius·sin(angle), with semi-axes a and b (1 for a
        circle).
        """
        r, theta = np.broadcast_arrays(np.asarray(radius, float), np.asarray(angle_rad, float))
        return position_map(self.unknowns, r.ravel(), theta.ravel()) @ self.coefficients

    def edge(self, count: int) -> Vectors:
        """Positions (count, 3) of equally spaced angles of the wire, from the one on +x."""
        return self.curve.position(np.arange(count, dtype=float) * (2 * np.pi / count))

    @cached_property
    def expansion(self) -> Expansion:
        """Coefficients by component and disc function."""
        out: Expansion = {}
        for unknown, coefficient in zip(self.unknowns, self.coefficients, strict=True):
            for term in unknown:
                key = (term.component, term.function)
                out[key] = out.get(key, 0.0) + term.weight * float(coefficient)
        return out

    @cached_property
    def curve(self) -> EdgeCurve:
        """The wire."""
        waves = 1 + max(term.function.m for unknown in self.unknowns for term in unknown)
        out = {"cos": np.zeros((waves, 3)), "sin": np.zeros((waves, 3))}
        for unknown, coefficient in zip(self.unknowns, self.coefficients.tolist(), strict=True):
            for term in unknown:
                f = term.function
                out[f.trig][f.m, term.component] += term.weight * coefficient * f.edge_value
        return EdgeCurve(out["cos"], out["sin"])

    @cached_property
    def height(self) -> float:
        """Rise of the wire from its lowest to its highest point, along the saddle's own axis."""
        return self.curve.extent

    @cached_property
    def width(self) -> float:
        """Distance of opposite crests: the pitch at which equal loops stand side by side.

        Negative when the crests have passed through each other.
        """
        crest = self.curve.crest
        x, y, _ = self.curve.position(np.array([crest]))[0]
        outward = x * np.cos(crest) + y * np.sin(crest)
        return float(np.copysign(2 * np.hypot(x, y), outward))

    @property
    def height_over_perimeter(self) -> float:
        """Height over the wire's length, h/(2π R)."""
        return self.height / (2 * np.pi)


def from_expansion(unknowns: tuple[Unknown, ...], expansion: Expansion) -> Vectors:
    """Coefficients (n,) that come nearest to an expansion; exact when it lies in the space.

    The unknowns must be orthonormal in the mean square over the disc.
    """
    return np.array(
        [
            sum(
                term.weight * expansion.get((term.component, term.function), 0.0)
                for term in unknown
            )
            for unknown in unknowns
        ]
    )
