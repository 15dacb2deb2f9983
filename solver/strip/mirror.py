"""A strip turned over: state − under a couple is state + under the opposite couple, mirrored."""

from __future__ import annotations

from solver.strip.balance import Point


def mirrored(point: Point) -> Point:
    """Reflect a shape in the chord; the force along the chord stays."""
    force = -point.force
    force[0] = point.force[0]
    return Point(-point.x, force, -point.couple, point.iterations)
