"""Where the solve of a large grid begins: the shape of a smaller one, with its middle repeated.

Away from its edges a grid whose gaps are kept repeats itself but for a rigid motion from each loop
to the next: it rolls up. From the flat state that takes a large grid hundreds of steps. The motion
is read off a small grid's middle, and copies of that middle are blended into each other.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from solver.mesh.array_mesh import Grid
from solver.mesh.triangulation import Mesh

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]

FEWEST = 3
"""Loops along a side of the smallest grid that has a middle."""
_HALF_WIDTH = 0.25
"""Of the strips on both sides of the middle that are laid on each other, in loops."""
_NEAR = 1e-6


@dataclass(frozen=True)
class Motion:
    """Rigid motion x ↦ x·turn + shift, of rows of positions.

    Attributes
    ----------
    turn : array (3, 3)
    shift : array (3,)
    """

    turn: Vectors
    shift: Vectors

    def moved(self, positions: Vectors) -> Vectors:
        """Positions (n, 3) after the motion."""
        return positions @ self.turn + self.shift

    def repeated(self, times: int) -> list[Motion]:
        """The motion made 0, 1, … ``times`` times."""
        out = [Motion(np.eye(3), np.zeros(3))]
        for _ in range(times):
            last = out[-1]
            out.append(Motion(last.turn @ self.turn, self.moved(last.shift[None])[0]))
        return out


def best_motion(start: Vectors, end: Vectors) -> Motion:
    """Rigid motion that brings positions (n, 3) nearest to others in the mean square.

    Kabsch, Acta Crystallogr. A 32 (1976) 922.
    """
    a, b = start.mean(axis=0), end.mean(axis=0)
    u, _, v = np.linalg.svd((start - a).T @ (end - b))
    turn = u * [1, 1, np.sign(np.linalg.det(u @ v))] @ v
    return Motion(turn, b - a @ turn)


def smaller(grid: Grid) -> Grid:
    """Grid of half as many rows and columns, but no fewer than have a middle."""

    def half(count: int) -> int:
        return min(count, max(FEWEST, -(-count // 2)))

    return Grid(half(grid.rows), half(grid.columns))


@dataclass(frozen=True)
class _Side:
    """Columns, or rows, of a small grid, whose middle one is repeated.

    Attributes
    ----------
    middle, missing : int
        The middle one, and how often it is repeated.
    turns : array (missing + 1, 3, 3)
    shifts : array (missing + 1, 3)
        Of the motion from one to the next, made 0, 1, … times.
    """

    middle: int
    missing: int
    turns: Vectors
    shifts: Vectors

    def copies(self, places: Vectors) -> list[tuple[Indices, Vectors]]:
        """Two copies that meet at places (n,), counted in loops, and the weight of each there."""
        beyond = places - self.middle
        copy = np.clip(np.floor(beyond).astype(np.int64), 0, self.missing)
        part = np.clip(beyond - copy, 0, 1)
        smooth = part * part * (3 - 2 * part)
        return [(copy, 1 - smooth), (np.minimum(copy + 1, self.missing), smooth)]

    def moved(self, positions: Vectors, copy: Indices) -> Vectors:
        """Positions (n, 3), each with the motion of its copy (n,)."""
        return np.einsum("na,nab->nb", positions, self.turns[copy]) + self.shifts[copy]


@dataclass(frozen=True)
class _Shape:
    """A small grid's vertices: places (n, 2) when flat, counted in loops, and positions (n, 3)."""

    places: Vectors
    positions: Vectors
    tree: cKDTree

    def at(self, places: Vectors) -> tuple[Vectors, NDArray[np.bool_]]:
        """Positions at places (n, 2), and whether a vertex lies there."""
        apart, nearest = self.tree.query(places)
        return self.positions[nearest], np.asarray(apart) < _NEAR

    def side(self, axis: int, count: int, wanted: int) -> _Side:
        """Read the motion along an axis off the middle of so many loops."""
        middle = count // 2
        before = np.abs(self.places[:, axis] - (middle - 0.5)) < _HALF_WIDTH
        after, there = self.at(self.places[before] + np.eye(2)[axis])
        step = best_motion(self.positions[before][there], after[there])
        motions = step.repeated(wanted - count)
        turns = np.stack([motion.turn for motion in motions])
        shifts = np.stack([motion.shift for motion in motions])
        return _Side(middle, wanted - count, turns, shifts)


def grown_start(
    small: Mesh, small_grid: Grid, positions: Vectors, mesh: Mesh, grid: Grid
) -> Vectors:
    """Positions (N, 3) of a grid's vertices from those (n, 3) of a smaller one, meshed alike."""
    places = _places(small)
    shape = _Shape(places, positions, cKDTree(places))
    across = shape.side(0, small_grid.columns, grid.columns)
    along = shape.side(1, small_grid.rows, grid.rows)
    wanted = _places(mesh)
    out = np.zeros((len(wanted), 3))
    for row, row_weight in along.copies(wanted[:, 1]):
        for column, column_weight in across.copies(wanted[:, 0]):
            weight = row_weight * column_weight
            on = weight > 0
            alike = wanted[on] - np.stack([column[on], row[on]], axis=1)
            copied = across.moved(along.moved(shape.at(alike)[0], row[on]), column[on])
            out[on] += weight[on, None] * copied
    return out


def _places(mesh: Mesh) -> Vectors:
    """Where vertices lie when flat (n, 2), counted in loops from the first one's middle."""
    first = mesh.rounds[0]
    return (mesh.points - first.centre) / (2 * np.array(first.semi_axes))
