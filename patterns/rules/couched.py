"""Where along its wire each needle point of the couching lies."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from patterns.locks import POINTS_PER_LOCK
from patterns.path import Vectors
from patterns.rules.subject import Subject
from patterns.stitching import ROUNDING_MM
from patterns.violation import Violation
from patterns.wire_index import Indices, Nearest, Numbers


@dataclass(frozen=True)
class Couched:
    """The needle points of one wire block between its locks, with their places on the wire.

    Attributes
    ----------
    block, stage : int
        Which block of the plan, and which stage it ties down.
    nearest : Nearest
        Place of every needle point of the block on its stage, those of the locks included.
    lead : int
        Needle points of the first lock, before the one that counts.
    station_mm, side_mm : arrays (n,)
        Of the needle points between the locks.
    """

    subject: Subject
    block: int
    stage: int
    nearest: Nearest
    lead: int
    station_mm: Numbers
    side_mm: Numbers

    @property
    def astray(self) -> Indices:
        """Needle points, counted through the block, that are not beside the wire."""
        allowed = ROUNDING_MM + self.subject.stitching.lock_length_mm
        with np.errstate(invalid="ignore"):
            return np.flatnonzero(~(self.nearest.overshoot_mm <= allowed))

    @property
    def needles_mm(self) -> Vectors:
        """Needle points (n, 2) between the locks."""
        end = self.lead + len(self.station_mm)
        return self.subject.needles_mm[self.block][self.lead : end]

    @property
    def rounding_mm(self) -> Numbers:
        """How much rounding can lengthen the advance of each stitch (n - 1,) along the wire.

        Seen from a point at distance d on the inside of a bend of radius R, the wire runs
        R / (R - d) times as far.
        """
        curvature = 1 / self.subject.circuit.smallest_radius_mm
        depth = np.minimum(np.abs(self.side_mm) * curvature, 0.5)
        stretched = ROUNDING_MM / (1 - depth)
        return stretched[1:] + stretched[:-1]

    def fault(self, rule: str, i: int, message: str, actual: float, allowed: float) -> Violation:
        """Report a fault at needle point ``i`` between the locks."""
        found = {"actual": actual, "allowed": allowed}
        return self.subject.fault(rule, message, self.block, self.lead + i, **found)


def couched(subject: Subject) -> Iterator[Couched]:
    """Look at every block that ties down a stage of the circuit."""
    for i, block in enumerate(subject.plan.blocks):
        known = 0 <= block.stage < len(subject.stages)
        if block.kind.is_wire and known and len(subject.needles_mm[i]):
            yield _couched(subject, i, block.stage)


def _couched(subject: Subject, block: int, stage: int) -> Couched:
    needles = subject.needles_mm[block]
    nearest = _places(subject, needles, stage)
    lead = _lock_points(subject, block, nearest.side_mm, 1)
    trail = _lock_points(subject, block, nearest.side_mm, -1)
    inner = slice(lead, max(len(needles) - trail, lead + 1))
    between = nearest.station_mm[inner], nearest.side_mm[inner]
    return Couched(subject, block, stage, nearest, lead, *between)


def _places(subject: Subject, needles_mm: Vectors, stage: int) -> Nearest:
    """Nearest places on a stage; of two, that which lies between those of the needle's neighbours.

    Beyond an earlier wire a needle may be nearer to another part of its own stage.
    """
    wire = subject.stages[stage]
    nearest = wire.nearest(needles_mm, subject.reach_mm)
    away = (nearest.station_mm, subject.reach_mm)
    other = wire.nearest(needles_mm, subject.reach_mm, away_from=away)
    padded = np.pad(nearest.station_mm, 1, mode="reflect" if len(needles_mm) > 1 else "edge")
    expected = (padded[2:] + padded[:-2]) / 2
    swap = np.abs(other.station_mm - expected) < np.abs(nearest.station_mm - expected)
    return Nearest(
        np.where(swap, other.distance_mm, nearest.distance_mm),
        np.where(swap, other.station_mm, nearest.station_mm),
        np.where(swap, other.side_mm, nearest.side_mm),
    )


def _lock_points(subject: Subject, block: int, side: Numbers, step: int) -> int:
    """Count the points before the last one at which a lock at one end still goes back and forth.

    Of a head that swings its needle the points lie on the wire, on no side of it.
    """
    needles, side = subject.needles_mm[block][::step], side[::step]
    size = subject.stitching.lock_length_mm + 2 * ROUNDING_MM
    near = np.hypot(*(needles - needles[0]).T) <= size
    swings = subject.machine.couching == "centreline"
    lock = near if swings else near & (side * side[0] > 0)
    count = int(np.argmin(lock)) - 1 if not np.all(lock) else len(needles) - 1
    return min(count, POINTS_PER_LOCK) if swings else count
