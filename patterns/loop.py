"""One loop of wire: a circle or an ellipse in the stretched plane."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, hypot, pi, sin, tau

import numpy as np
from numpy.typing import ArrayLike, NDArray

from patterns.ellipse import semi_axes

Floats = NDArray[np.float64]

Cell = tuple[int, int]
"""Row, counted from the bottom, and column, counted from the left; both from 0."""


@dataclass(frozen=True, slots=True)
class Loop:
    """One ellipse of wire, mostly a circle.

    Places on it are named by the direction in which its outward normal points there: on a circle
    that is the angle around the centre, and everywhere the wire is square to it.

    Attributes
    ----------
    x_mm, y_mm : float
        Centre; y points away from the operator.
    diameter_mm : float
        Diameter of the circle that is as long around, on the wire's centreline.
    axis_ratio : float
        Length over width, at least 1: of a circle 1.
    axis_rad : float
        Direction of the long axis.
    cell : (int, int) or None
        Row and column on a lattice.
    """

    x_mm: float
    y_mm: float
    diameter_mm: float
    axis_ratio: float = 1.0
    axis_rad: float = 0.0
    cell: Cell | None = None

    @property
    def radius_mm(self) -> float:
        """Radius of the circle that is as long around."""
        return self.diameter_mm / 2

    @property
    def around_mm(self) -> float:
        """Perimeter."""
        return pi * self.diameter_mm

    @property
    def semi_axes_mm(self) -> tuple[float, float]:
        """Half the length and half the width."""
        return semi_axes(self.diameter_mm, self.axis_ratio)

    @property
    def width_mm(self) -> float:
        """Length of the short axis."""
        return 2 * self.semi_axes_mm[1]

    @property
    def smallest_radius_mm(self) -> float:
        """Bend radius in the ends of the long axis: b²/a."""
        long, short = self.semi_axes_mm
        return short * short / long

    @property
    def largest_radius_mm(self) -> float:
        """Bend radius in the ends of the short axis: a²/b."""
        long, short = self.semi_axes_mm
        return long * long / short

    @property
    def place(self) -> str:
        """Row and column, from 1, or the centre, in words."""
        if self.cell is None:
            return f"at ({self.x_mm:g}, {self.y_mm:g}) mm"
        return f"in row {self.cell[0] + 1}, column {self.cell[1] + 1}"

    def along_mm(self, angle_rad: float) -> float:
        """Distance from the centre to the wire's centreline in a direction."""
        a, b = self.semi_axes_mm
        turned = angle_rad - self.axis_rad
        return 1 / float(np.hypot(np.cos(turned) / a, np.sin(turned) / b))

    def reach_mm(self, normal_rad: float) -> float:
        """How far it goes from its centre in a direction: the support function."""
        long, short = self.semi_axes_mm
        angle = normal_rad - self.axis_rad
        return long if long == short else hypot(long * cos(angle), short * sin(angle))

    def box_mm(self) -> tuple[float, float, float, float]:
        """Box (xmin, ymin, xmax, ymax) around the wire's centreline."""
        x, y = self.reach_mm(0.0), self.reach_mm(pi / 2)
        return self.x_mm - x, self.y_mm - y, self.x_mm + x, self.y_mm + y

    def eccentric_rad(self, normal_rad: ArrayLike) -> Floats:
        """Eccentric angles of places; they grow with the direction and turn as often."""
        long, short = self.semi_axes_mm
        angle = np.asarray(normal_rad, dtype=float) - self.axis_rad
        sine, cosine = np.sin(angle), np.cos(angle)
        lag = np.arctan2((short - long) * sine * cosine, long * cosine**2 + short * sine**2)
        return angle + lag

    def at_eccentric(self, eccentric_rad: ArrayLike) -> tuple[Floats, Floats]:
        """Points and unit tangents (counter-clockwise), each (n, 2), at eccentric angles (n,)."""
        long, short = self.semi_axes_mm
        angle = np.atleast_1d(np.asarray(eccentric_rad, dtype=float))
        sine, cosine = np.sin(angle), np.cos(angle)
        aside, ahead = sin(self.axis_rad), cos(self.axis_rad)
        turn = np.array([(ahead, aside), (-aside, ahead)])
        point = np.stack([long * cosine, short * sine], axis=1) @ turn
        point += np.array((self.x_mm, self.y_mm))
        along = np.stack([-long * sine, short * cosine], axis=1) @ turn
        along /= np.hypot(*along.T)[:, None]
        return point, along

    def point_mm(self, normal_rad: float) -> tuple[float, float]:
        """Point in which the outward normal has a direction."""
        if self.axis_ratio == 1:
            out = self.radius_mm
            return self.x_mm + out * cos(normal_rad), self.y_mm + out * sin(normal_rad)
        x, y = self.at_eccentric(self.eccentric_rad(normal_rad))[0][0].tolist()
        return x, y

    def normal_rad(self, x_mm: float, y_mm: float) -> float:
        """Direction (0 to 2 pi) of the outward normal in a point of the loop."""
        long, short = self.semi_axes_mm
        if long == short:
            return atan2(y_mm - self.y_mm, x_mm - self.x_mm) % tau
        along, across = self._from_centre(x_mm, y_mm)
        return (atan2(across / short**2, along / long**2) + self.axis_rad) % tau

    def holds(self, x_mm: float, y_mm: float) -> bool:
        """Whether a point lies inside."""
        long, short = self.semi_axes_mm
        along, across = self._from_centre(x_mm, y_mm)
        return hypot(along / long, across / short) < 1

    def _from_centre(self, x_mm: float, y_mm: float) -> tuple[float, float]:
        """Coordinates of a point along the long and the short axis."""
        x, y = x_mm - self.x_mm, y_mm - self.y_mm
        ahead, aside = cos(self.axis_rad), sin(self.axis_rad)
        return x * ahead + y * aside, y * ahead - x * aside
