"""How far apart loops are, and where they touch."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from patterns.loop import Loop

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

_DIRECTIONS = 96
_MOST_STEPS = 30
_PAIRS_AT_ONCE = 4096


class LoopGaps:
    """Distances between the loops of an arrangement.

    Two convex bodies are as far apart as the widest strip between them: over all directions u the
    largest u·(c₂ - c₁) - h₁(u) - h₂(u), with the support functions h (R. T. Rockafellar, Convex
    Analysis, 1970, section 13; of an ellipse √(a² cos² + b² sin²)). Where they overlap this is
    negative: minus the shortest way to move one until they touch.

    Parameters
    ----------
    loops
        Circles and ellipses, in any directions.
    """

    def __init__(self, loops: tuple[Loop, ...]) -> None:
        self.centre: Floats = np.array([(one.x_mm, one.y_mm) for one in loops]).reshape(-1, 2)
        self.axes: Floats = np.array([one.semi_axes_mm for one in loops]).reshape(-1, 2)
        self.axis_rad: Floats = np.array([one.axis_rad for one in loops])

    def at_least_mm(self, first: Indices, second: Indices) -> Floats:
        """Give what the gaps of pairs are at least, from circles around the loops; quickly."""
        apart = np.hypot(*(self.centre[second] - self.centre[first]).T)
        return apart - self.axes[first, 0] - self.axes[second, 0]

    def of(self, first: Indices, second: Indices) -> tuple[Floats, Floats]:
        """Measure pairs of loops.

        Returns
        -------
        gap_mm : array (n,)
            Distance of the curves; negative where loops overlap.
        point_mm : array (n, 2)
            The point between them, from both as their extents share the gap.
        """
        direction = self._between(first, second)
        gap = np.sum((self.centre[second] - self.centre[first]) * direction, axis=1)
        angle = np.arctan2(direction[:, 1], direction[:, 0])
        one, other = self._support(first, angle)[0], self._support(second, angle)[0]
        gap -= one + other
        share = (gap * one / (one + other))[:, None]
        return gap, self._points(first, direction) + share * direction

    def _between(self, first: Indices, second: Indices) -> Floats:
        """Directions (n, 2) of the widest strips, from the first loop to the second."""
        apart = self.centre[second] - self.centre[first]
        distance = np.hypot(*apart.T)[:, None]
        ahead = np.divide(
            apart, distance, out=np.tile((1.0, 0.0), (len(apart), 1)), where=distance > 0
        )
        oval = np.flatnonzero(
            (self.axes[first, 0] > self.axes[first, 1])
            | (self.axes[second, 0] > self.axes[second, 1])
        )
        for k in range(0, len(oval), _PAIRS_AT_ONCE):
            part = oval[k : k + _PAIRS_AT_ONCE]
            angle = self._widest_rad(first[part], second[part])
            ahead[part] = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        return ahead

    def _widest_rad(self, first: Indices, second: Indices) -> Floats:
        """Try directions all around, and go on from the best with Newton's method."""
        spread = 2 * np.pi * np.arange(_DIRECTIONS) / _DIRECTIONS
        tried = [self._strip(first, second, np.full(len(first), one))[0] for one in spread]
        angle = spread[np.argmax(tried, axis=0)]
        low, high = angle - spread[1], angle + spread[1]
        for _ in range(_MOST_STEPS):
            _, slope, bend = self._strip(first, second, angle)
            low, high = np.where(slope > 0, angle, low), np.where(slope > 0, high, angle)
            newton = angle - np.divide(slope, bend, out=np.full_like(bend, np.inf), where=bend < 0)
            inside = (newton > low) & (newton < high)
            following = np.where(inside, newton, (low + high) / 2)
            following = np.where(slope == 0, angle, following)
            done = np.abs(following - angle).max(initial=0.0) < 1e-15
            angle = following
            if done:
                break
        return angle

    def _strip(
        self, first: Indices, second: Indices, angle_rad: Floats
    ) -> tuple[Floats, Floats, Floats]:
        """Width of the strip between two loops, and its two derivatives by the direction."""
        x, y = (self.centre[second] - self.centre[first]).T
        sine, cosine = np.sin(angle_rad), np.cos(angle_rad)
        width, slope = x * cosine + y * sine, y * cosine - x * sine
        bend = -width
        for loop in (first, second):
            support, support_slope, support_bend = self._support(loop, angle_rad)
            width, slope = width - support, slope - support_slope
            bend = bend - support_bend
        return width, slope, bend

    def _support(self, loop: Indices, angle_rad: Floats) -> tuple[Floats, Floats, Floats]:
        """Support function of loops and its two derivatives by the direction."""
        long, short = self.axes[loop].T
        mean, swing = (long**2 + short**2) / 2, (long**2 - short**2) / 2
        twice = 2 * (angle_rad - self.axis_rad[loop])
        support = np.sqrt(mean + swing * np.cos(twice))
        slope = -swing * np.sin(twice) / support
        bend = (-2 * swing * np.cos(twice) - slope**2) / support
        return support, slope, bend

    def _points(self, loop: Indices, direction: Floats) -> Floats:
        """Points (n, 2) of loops in which their outward normals have the directions."""
        long, short = self.axes[loop].T
        cosine, sine = np.cos(self.axis_rad[loop]), np.sin(self.axis_rad[loop])
        x, y = direction.T
        along, across = x * cosine + y * sine, y * cosine - x * sine
        support = np.hypot(long * along, short * across)
        along, across = long**2 * along / support, short**2 * across / support
        turned = np.stack([along * cosine - across * sine, along * sine + across * cosine], axis=1)
        return self.centre[loop] + turned
