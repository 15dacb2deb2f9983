"""Wire on the fabric, made ready to be asked how near to it a point is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from patterns.path import Piece, Vectors, WirePath
from patterns.piece_cells import PieceCells

Lengths = NDArray[np.float64]


@dataclass(frozen=True)
class LaidWire:
    """Centrelines of wire; made by `laid_wire`.

    Attributes
    ----------
    pieces : tuple of Line or Arc
        The n pieces of all the wire.
    cells : PieceCells
        The same, to be looked up.
    radius_mm : array (n,)
        Half the diameter of the wire of each piece.
    like_mm : float
        Distances are as if to wire of this radius: a thicker wire is nearer by the difference.
    """

    pieces: tuple[Piece, ...]
    cells: PieceCells
    radius_mm: Lengths
    like_mm: float = 0.0

    def like(self, wire_diameter_mm: float) -> LaidWire:
        """Measure distances as if to the centreline of wire of a diameter."""
        return replace(self, like_mm=wire_diameter_mm / 2)

    def distance_mm(self, points_mm: Vectors, reach_mm: float) -> Lengths:
        """Distance (n,) from points (n, 2) to the nearest centreline; infinite beyond the reach."""
        thicker = self.radius_mm - self.like_mm
        reach = reach_mm + max(float(thicker.max(initial=0.0)), 0.0)
        which, piece = self.cells.near(points_mm, reach)
        exact = self.cells.distance_mm(points_mm[which], piece) - thicker[piece]
        nearest = np.full(len(points_mm), np.inf)
        np.minimum.at(nearest, which, exact)
        nearest[nearest > reach_mm] = np.inf
        return nearest


def laid_wire(*paths: WirePath, wire_diameter_mm: float = 0.0) -> LaidWire:
    """Make paths of one wire ready for `LaidWire.distance_mm`, measured to its centreline."""
    pieces = tuple(piece for path in paths for piece in path.pieces)
    return LaidWire(
        pieces,
        PieceCells(pieces),
        np.full(len(pieces), wire_diameter_mm / 2),
        wire_diameter_mm / 2,
    )


def all_laid(parts: Sequence[LaidWire]) -> LaidWire:
    """Put wires together; distances are measured as for the last of them."""
    pieces = tuple(piece for part in parts for piece in part.pieces)
    return LaidWire(
        pieces,
        PieceCells(pieces),
        np.concatenate([part.radius_mm for part in parts]),
        parts[-1].like_mm,
    )
