"""A flat piece that is cut from sheet: its outside, its openings and its round holes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import pi

from shapely import Point, Polygon

from patterns.contour import Contour
from patterns.outline import CHORD_TOLERANCE_MM

POLYCARBONATE_G_CM3 = 1.20
"""Density of polycarbonate (ISO 1183; data sheet of KERN, material 2301)."""

POLYCARBONATE_THICKNESS_MM = 0.38
"""Thickness of the published beams (0.015 inches; the paper, II-B3)."""


@dataclass(frozen=True, slots=True)
class Hole:
    """A round hole, kept as a circle."""

    x_mm: float
    y_mm: float
    diameter_mm: float

    @property
    def area_mm2(self) -> float:
        """Area that the hole takes away."""
        return pi * self.diameter_mm**2 / 4


@dataclass(frozen=True, slots=True)
class CutPiece:
    """A piece of sheet.

    Attributes
    ----------
    name : str
        What it is called in files and messages.
    outside : Contour
        Counter-clockwise.
    holes : tuple of Hole
    openings : tuple of Contour
        Clockwise.
    kerf_mm : float or None
        Width of cut that this piece is compensated for, when it is not the sheet's.
    """

    name: str
    outside: Contour
    holes: tuple[Hole, ...] = ()
    openings: tuple[Contour, ...] = ()
    kerf_mm: float | None = None

    @property
    def area_mm2(self) -> float:
        """Area of the material, exact."""
        away = sum(hole.area_mm2 for hole in self.holes)
        # openings run clockwise: their area is negative
        return self.outside.area_mm2 + sum(one.area_mm2 for one in self.openings) - away

    @property
    def bounds_mm(self) -> tuple[float, float, float, float]:
        """Box (xmin, ymin, xmax, ymax) around the piece, to within the chord tolerance."""
        ring = self.outside.ring()
        (left, bottom), (right, top) = ring.min(axis=0).tolist(), ring.max(axis=0).tolist()
        return left, bottom, right, top

    @property
    def size_mm(self) -> tuple[float, float]:
        """Width and height of that box."""
        left, bottom, right, top = self.bounds_mm
        return right - left, top - bottom

    def mass_g(
        self,
        thickness_mm: float = POLYCARBONATE_THICKNESS_MM,
        density_g_cm3: float = POLYCARBONATE_G_CM3,
    ) -> float:
        """Mass of the piece: area, thickness and density."""
        return self.area_mm2 * thickness_mm * density_g_cm3 / 1000

    def polygon(self, tolerance_mm: float = CHORD_TOLERANCE_MM) -> Polygon:
        """Give the material as a polygon, its arcs as chords within the tolerance."""
        circles = [
            Point(hole.x_mm, hole.y_mm).buffer(hole.diameter_mm / 2, quad_segs=64).exterior
            for hole in self.holes
        ]
        openings = [one.ring(tolerance_mm) for one in self.openings]
        return Polygon(self.outside.ring(tolerance_mm), [*openings, *circles])

    def moved(self, x_mm: float, y_mm: float) -> CutPiece:
        """Shift the piece."""
        holes = (replace(h, x_mm=h.x_mm + x_mm, y_mm=h.y_mm + y_mm) for h in self.holes)
        return replace(
            self,
            outside=self.outside.moved(x_mm, y_mm),
            holes=tuple(holes),
            openings=tuple(one.moved(x_mm, y_mm) for one in self.openings),
        )

    def quarter_turned(self) -> CutPiece:
        """Turn the piece counter-clockwise by a right angle about the origin."""
        return replace(
            self,
            outside=self.outside.quarter_turned(),
            holes=tuple(replace(h, x_mm=-h.y_mm, y_mm=h.x_mm) for h in self.holes),
            openings=tuple(one.quarter_turned() for one in self.openings),
        )


def numbered(piece: CutPiece, count: int) -> tuple[CutPiece, ...]:
    """Give the same piece several times, its name counted from 1."""
    return tuple(replace(piece, name=f"{piece.name} {k}") for k in range(1, count + 1))
