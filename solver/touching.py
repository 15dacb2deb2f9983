"""Where a loop between plates touches them, or would: the humps of its wire, and fabric points.

The wire is outside a plate when the highest point of one of its humps is. That point's height is a
function φ of the unknowns. Its slope is the point's own row c; its curvature is s sᵀ/k, since the
highest point moves along the wire: s is the row of the wire's slope there and k = −∂²x/∂θ² > 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from solver.disc_basis import DiscBasis, position_map
from solver.edge_rows import EdgeRows, edge_rows
from solver.plates import Contact, Pitch, PlateAxis, Plates

Vectors = NDArray[np.float64]

_SAMPLES = 65
_SAMPLED = np.linspace(0.0, np.pi / 2, _SAMPLES)
"""Angles on a quarter of the wire, its ends included."""

_RADII = np.linspace(0.1, 0.96, 12)
_ANGLES = np.linspace(0.0, np.pi / 2, 17)
"""Points of the fabric that must not pass a plate; taut fabric never reaches one before the wire.

On taut fabric each coordinate obeys an elliptic equation, div(S grad x) = 0 with S positive
definite, so that it is greatest on the edge (the maximum principle).
"""

_NEAR = 0.5
"""How far a touching point may move from one step to the next."""

_MARGIN = 0.1
"""How near to a plate a point of the fabric is watched."""

_FAR = 0.3
"""Humps that much lower than the highest are not looked at."""

_SPACING = float(_SAMPLED[1])
_CLOSE = 1e-12
_NEWTON_STEPS = 8
_FLATTEST = 1e-9
"""Least k; where it is reached, the wire lies along the plate."""


@dataclass(frozen=True, eq=False)
class Touches:
    """Linear models of what may touch, or is held.

    Attributes
    ----------
    excess : array (k,)
        How far each is beyond its plate, or from where it is held.
    rows, slopes : array (k, n)
        Its slope c by the unknowns, and s.
    bends : array (k,)
        k; infinite for points that do not move along the wire.
    radii, angles : array (k,)
        Where it is in the disc.
    sides : array (k,)
        1 at the greater coordinate, −1 at the lesser.
    """

    excess: Vectors
    rows: Vectors
    slopes: Vectors
    bends: Vectors
    radii: Vectors
    angles: Vectors
    sides: Vectors

    def curvature(self, force: Vectors) -> Vectors:
        """Second derivatives (n, n) of Σ force φ."""
        return (self.slopes.T * (force / self.bends)) @ self.slopes

    def chosen(self, which: NDArray[np.bool_]) -> Touches:
        """Give some of them."""
        return Touches(
            self.excess[which],
            self.rows[which],
            self.slopes[which],
            self.bends[which],
            self.radii[which],
            self.angles[which],
            self.sides[which],
        )

    def forces_of(self, contacts: Sequence[Contact]) -> Vectors:
        """Forces (k,) of those here that lie nearest to contacts of another shape."""
        out = np.zeros(len(self.excess))
        for contact in contacts:
            away = np.hypot(self.angles - contact.angle_rad, self.radii - contact.radius)
            away[(self.sides > 0) != contact.upper] = np.inf
            if away.size and away.min() < _NEAR:
                out[int(np.argmin(away))] += contact.force
        return out

    def contacts(self, force: Vectors) -> tuple[Contact, ...]:
        """Give the contacts where forces (k,) are."""
        return tuple(
            Contact(
                radius=float(self.radii[i]),
                angle_rad=float(self.angles[i]),
                force=float(force[i]),
                bend=float(self.bends[i]),
                upper=bool(self.sides[i] > 0),
            )
            for i in np.flatnonzero(force)
        )


@dataclass(frozen=True, eq=False)
class _Points:
    """Fixed points of the loop: rows (k, n) of one coordinate, and where they are in the disc."""

    rows: Vectors
    radii: Vectors
    angles: Vectors

    def touches(self, q: Vectors, side: float, reach: float) -> Touches:
        """Those that are near to a plate."""
        excess = side * (self.rows @ q) - reach
        near = excess > -_MARGIN
        rows, k = self.rows[near], int(near.sum())
        return Touches(
            excess=excess[near],
            rows=side * rows,
            slopes=np.zeros_like(rows),
            bends=np.full(k, np.inf),
            radii=self.radii[near],
            angles=self.angles[near],
            sides=np.full(k, side),
        )


@dataclass(frozen=True, eq=False)
class _Surroundings:
    """A basis' shapes where they are looked at: all along the wire, at samples of it, in fabric."""

    wire: EdgeRows
    samples: _Points
    fabric: _Points


@lru_cache(maxsize=64)
def _surroundings(basis: DiscBasis, component: int) -> _Surroundings:
    wire = edge_rows(basis, component)
    samples = _Points(wire.at(_SAMPLED)[0], np.ones(_SAMPLES), _SAMPLED)
    radii, angles = (grid.ravel() for grid in np.meshgrid(_RADII, _ANGLES, indexing="ij"))
    inside = np.ascontiguousarray(position_map(basis.unknowns, radii, angles)[:, component])
    return _Surroundings(wire, samples, _Points(inside, radii, angles))


def _humps(at: _Surroundings, q: Vectors, side: float) -> Vectors:
    """Angles of the highest points of the wire's humps on a quarter that its mirrors repeat.

    The highest samples, refined by Newton's steps; at the quarter's ends the slope is 0.
    """
    values = side * (at.samples.rows @ q)
    mirrored = np.concatenate([values[1:2], values, values[-2:-1]])
    top = (values >= mirrored[:-2]) & (values >= mirrored[2:]) & (values > values.max() - _FAR)
    first = _SAMPLED[top]
    found, wave = first, at.wire.of(side * q)
    for _ in range(_NEWTON_STEPS):
        _, slope, bend = (derivative[:, 0] for derivative in wave.at(found))
        step = np.where(bend < 0, slope / np.minimum(bend, -_FLATTEST), 0.0)
        found = np.clip(found - step, first - _SPACING, first + _SPACING)
        if np.abs(step).max() < _CLOSE:
            break
    return np.abs(found)


def _wire_touches(at: _Surroundings, q: Vectors, side: float, reach: float) -> Touches:
    angles = _humps(at, q, side)
    rows, slopes, bends = at.wire.at(angles)
    return Touches(
        excess=side * (rows @ q) - reach,
        rows=side * rows,
        slopes=side * slopes,
        bends=np.maximum(-side * (bends @ q), _FLATTEST),
        radii=np.ones_like(angles),
        angles=angles,
        sides=np.full_like(angles, side),
    )


def joined(parts: list[Touches]) -> Touches:
    """Give several as one."""
    return Touches(
        *(
            np.concatenate([getattr(part, name) for part in parts])
            for name in ("excess", "rows", "slopes", "bends", "radii", "angles", "sides")
        )
    )


def plate_touches(
    basis: DiscBasis, plates: Plates, q: Vectors, *, sampled: bool = False
) -> Touches:
    """Find what touches two plates, or is near to, of a shape q (n,) with two mirrors.

    One of each set of mirror images is listed. ``sampled`` watches fixed points of the wire instead
    of its humps: where the wire lies along a plate, humps come and go.
    """
    at = _surroundings(basis, plates.axis.component)
    parts: list[Touches] = []
    for side in (1.0, -1.0) if plates.axis is PlateAxis.HEIGHT else (1.0,):
        if sampled:
            parts.append(at.samples.touches(q, side, plates.wire_reach))
        else:
            parts.append(_wire_touches(at, q, side, plates.wire_reach))
        parts.append(at.fabric.touches(q, side, plates.fabric_reach))
    return joined(parts)


def reach(basis: DiscBasis, component: int, q: Vectors, side: float = 1.0) -> float:
    """Farthest that the wire of a shape with two mirrors gets along ± one axis, in units of R."""
    at = _surroundings(basis, component)
    return float(at.wire.of(side * q).at(_humps(at, q, side))[0].max())


def held_points(basis: DiscBasis, pitch: Pitch, q: Vectors) -> Touches:
    """Give the crest on +x, and the valley on +y if it is held too, of a shape q (n,)."""
    held = [(0, 0.0, pitch.pitch / 2)]
    held += [(1, np.pi / 2, pitch.width / 2)] if pitch.width is not None else []
    rows = np.array([edge_rows(basis, c).at(np.array([angle]))[0][0] for c, angle, _ in held])
    k = len(held)
    return Touches(
        excess=rows @ q - np.array([reach for *_, reach in held]),
        rows=rows,
        slopes=np.zeros_like(rows),
        bends=np.full(k, np.inf),
        radii=np.ones(k),
        angles=np.array([angle for _, angle, _ in held]),
        sides=np.ones(k),
    )
