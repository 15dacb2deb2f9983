"""The lines along which the fabric is cut at release."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from shapely import (
    LineString,
    MultiPolygon,
    Polygon,
    STRtree,
    buffer,
    contains_properly,
    covers,
    get_parts,
    maximum_inscribed_circle,
    polygonize,
    prepare,
    union_all,
)
from shapely.geometry.base import BaseGeometry

from patterns.circuit import Circuit, Diameters
from patterns.edge_clearance import edge_clearance_mm
from patterns.errors import PatternError
from patterns.layout import Layout
from patterns.loop_ring import CHORD_MM, Ring, quarter_steps, ring_around
from patterns.path import Line, Piece, WirePath
from patterns.wire_index import WireIndex

CHORD_TOLERANCE_MM = 0.01
"""Largest distance between the cut line and the arcs that it stands for."""

_FIRST_EXCESS_MM = 0.003
_FACE_TOLERANCE_MM = 1e-3
_SAME_MM = 1e-6


@dataclass(frozen=True)
class Outline:
    """Cut lines on the stretched fabric.

    Attributes
    ----------
    outside : Ring
        Counter-clockwise.
    openings : tuple of Ring
        Clockwise: the fabric between the loops that goes away.
    further : tuple of Ring
        Outside lines of further pieces of fabric, when circuits lie apart; counter-clockwise.
    """

    outside: Ring
    openings: tuple[Ring, ...]
    further: tuple[Ring, ...] = ()

    @property
    def outsides(self) -> tuple[Ring, ...]:
        """The outside line of every piece of fabric."""
        return (self.outside, *self.further)

    @property
    def rings(self) -> tuple[Ring, ...]:
        """All cut lines, the outsides first."""
        return (*self.outsides, *self.openings)

    @property
    def bounds_mm(self) -> tuple[float, float, float, float]:
        """Box (xmin, ymin, xmax, ymax) around all fabric."""
        corners = np.concatenate(self.outsides)
        (left, bottom), (right, top) = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
        return left, bottom, right, top

    def fabric(self) -> MultiPolygon:
        """Give the fabric that is left, a polygon a piece."""
        pieces = [Polygon(ring) for ring in self.outsides]
        openings = np.array([Polygon(ring) for ring in self.openings], dtype=np.object_)
        prepare(pieces)
        return MultiPolygon(
            [
                Polygon(
                    piece.exterior, [hole.exterior for hole in openings[covers(piece, openings)]]
                )
                for piece in pieces
            ]
        )

    def edges_mm(self) -> tuple[Ring, Ring]:
        """Starts and ends (n, 2) of the straight edges of all rings, in order."""
        ends = [np.roll(ring, -1, axis=0) for ring in self.rings]
        return np.concatenate(self.rings), np.concatenate(ends)


def cut_outline(
    circuit: Circuit,
    wire_diameter_mm: Diameters,
    margin_mm: float,
    corner_radius_mm: float,
    *,
    keep_between: bool = False,
) -> Outline:
    """Leave the fabric in and around the loops and along the tails; cut the rest away.

    Parameters
    ----------
    circuit : Circuit
        The wire.
    wire_diameter_mm : float or tuple of float
        Its diameter; of several circuits, the thickest counts.
    margin_mm : float
        Least fabric between the wire's surface and a cut.
    corner_radius_mm : float
        Radius of inner corners, rounded by leaving more fabric; 0 leaves them sharp.
    keep_between : bool
        Whether to leave the fabric that loops enclose between them, too.

    Raises
    ------
    PatternError
        When a quantity is out of range, or an opening that loops enclose would vanish; the message
        gives the largest margin that leaves it.
    """
    thickest = max(circuit.of_stages(wire_diameter_mm))
    _check_quantities(thickest, margin_mm, corner_radius_mm)
    clearance = thickest / 2 + margin_mm
    wire = WireIndex(circuit.wire)
    for excess in (_FIRST_EXCESS_MM, CHORD_TOLERANCE_MM):
        fabric = _fabric(circuit, clearance + excess, corner_radius_mm)
        if keep_between:
            fabric = _without_openings(circuit.layout, fabric)
        else:
            _check_openings(circuit.layout, fabric, thickest, corner_radius_mm)
        outline = _outline(fabric)
        if edge_clearance_mm(*outline.edges_mm(), wire, 2 * clearance).min() >= clearance:
            return outline
    raise PatternError(
        f"no cut line keeps {margin_mm:g} mm from the wire: two stretches of it, or a loop and a "
        "tail, lie so that fabric cannot be left around both"
    )


def _check_quantities(wire_diameter_mm: float, margin_mm: float, corner_radius_mm: float) -> None:
    if wire_diameter_mm <= 0 or margin_mm <= 0 or corner_radius_mm < 0:
        raise PatternError(
            f"no outline for {wire_diameter_mm:g} mm wire, a margin of {margin_mm:g} mm and a "
            f"corner radius of {corner_radius_mm:g} mm: the first two must be positive, the "
            "radius not negative"
        )


def _fabric(circuit: Circuit, clearance_mm: float, corner_radius_mm: float) -> list[Polygon]:
    """Grow loops and tails by clearance and corner radius, and shrink by the corner radius.

    The result holds everything within the clearance, and its inner corners are round.
    """
    grown = clearance_mm + corner_radius_mm
    parts = [
        *(Polygon(ring_around(loop, grown)) for loop in circuit.layout.loops),
        *(_grown(piece, grown) for piece in _beside_loops(circuit)),
    ]
    fabric = get_parts(union_all(parts)).tolist()
    if corner_radius_mm > 0:
        shrunk = [_shrunk(piece, corner_radius_mm) for piece in fabric]
        fabric = [part for piece in shrunk for part in get_parts(piece).tolist()]
    pieces = [piece for piece in fabric if not piece.is_empty]
    if not 0 < len(pieces) <= len(circuit.parts):
        raise PatternError("the fabric falls apart: the wire does not hold all loops together")
    return sorted(pieces, key=lambda piece: piece.bounds)


def _shrunk(fabric: Polygon, by_mm: float) -> BaseGeometry:
    """Take a strip off a piece of fabric: off its outside, and around each opening by itself.

    At once is the same, but takes much longer where there are many openings; it is done when they
    would run into one another or into the outside.
    """
    steps = quarter_steps(by_mm)
    outside = Polygon(fabric.exterior).buffer(-by_mm, quad_segs=steps)
    openings = buffer([Polygon(ring) for ring in fabric.interiors], by_mm, quad_segs=steps)
    if outside.geom_type == "Polygon" and not outside.is_empty:
        prepare(outside)
        first, _ = STRtree(openings).query(openings, predicate="intersects")
        whole = all(not one.interiors for one in openings)
        if len(first) == len(openings) and whole and contains_properly(outside, openings).all():
            return Polygon(outside.exterior, [one.exterior for one in openings])
    return fabric.buffer(-by_mm, quad_segs=steps)


def _beside_loops(circuit: Circuit) -> list[Piece]:
    """Wire of tails, and of links between rows of loops."""
    paths = (path for part in circuit.parts for path in (*part.tails, *part.links))
    return [piece for path in paths for piece in path.pieces]


def _grown(piece: Piece, clearance_mm: float) -> BaseGeometry:
    """Polygon around everything within the clearance of a line or arc."""
    if isinstance(piece, Line):
        centreline = LineString([(piece.x0_mm, piece.y0_mm), (piece.x1_mm, piece.y1_mm)])
    else:
        centreline = WirePath((piece,)).line_string(CHORD_MM)
        clearance_mm += CHORD_MM
    steps = quarter_steps(clearance_mm)
    return centreline.buffer(clearance_mm / np.cos(np.pi / 4 / steps), quad_segs=steps)


def _outline(fabric: list[Polygon]) -> Outline:
    outside, *further = (np.array(one.exterior.normalize().coords)[:-1] for one in fabric)
    holes = (ring for one in fabric for ring in one.interiors)
    openings = (np.array(ring.normalize().coords)[:-1] for ring in holes)
    ordered = sorted(openings, key=lambda ring: (ring[:, 1].min(), ring[:, 0].min()))
    return Outline(
        _turned(outside, 1),
        tuple(_turned(ring, -1) for ring in ordered),
        tuple(_turned(ring, 1) for ring in further),
    )


def _turned(ring: Ring, sense: int) -> Ring:
    """Give the ring counter-clockwise (1) or clockwise (-1), every corner once."""
    ring = ring[np.hypot(*(np.roll(ring, -1, axis=0) - ring).T) > _SAME_MM]
    x, y = ring.T
    area = np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))
    return ring if area * sense > 0 else ring[::-1].copy()


def _check_openings(
    layout: Layout, fabric: list[Polygon], wire_diameter_mm: float, corner_radius_mm: float
) -> None:
    """Find an opening in every face of the touching graph."""
    faces = _faces(layout)
    tree = STRtree([Polygon(ring) for one in fabric for ring in one.interiors])
    open_faces = set(tree.query(faces, predicate="intersects")[0].tolist()) if faces else set()
    closed = [face for k, face in enumerate(faces) if k not in open_faces]
    if not closed:
        return
    room = min(_room_mm(layout, face) for face in closed)
    largest = np.floor((room - corner_radius_mm - wire_diameter_mm / 2 - CHORD_TOLERANCE_MM) * 100)
    advice = (
        f"the largest margin that leaves it is {largest / 100:.2f} mm"
        if largest > 0
        else f"the corner radius must be less than {room - wire_diameter_mm / 2:.2f} mm"
    )
    x, y = closed[0].centroid.coords[0]
    raise PatternError(
        f"the opening between the loops around ({x:.1f}, {y:.1f}) mm vanishes: with a corner "
        f"radius of {corner_radius_mm:g} mm, {advice}"
    )


def _without_openings(layout: Layout, fabric: list[Polygon]) -> list[Polygon]:
    """Fill what loops enclose; an opening beside a tail, which encloses it with them, stays."""
    between: BaseGeometry = union_all(_faces(layout))
    return [
        Polygon(
            one.exterior,
            [ring for ring in one.interiors if not Polygon(ring).intersects(between)],
        )
        for one in fabric
    ]


def _faces(layout: Layout) -> list[BaseGeometry]:
    """Polygons between the centres of loops that touch in a round, by way of the contacts."""
    places = [(loop.x_mm, loop.y_mm) for loop in layout.loops]
    links = [
        LineString([places[one.first], (one.x_mm, one.y_mm), places[one.second]])
        for one in layout.contacts
    ]
    return list(get_parts(polygonize(links)))


def _room_mm(layout: Layout, face: BaseGeometry) -> float:
    """Radius of the largest circle in a face that stays outside the loops."""
    discs = [Polygon(ring_around(loop)) for loop in layout.loops]
    near = STRtree(discs).query(face)
    gap = face.difference(union_all([discs[k] for k in near]))
    return max(maximum_inscribed_circle(part, _FACE_TOLERANCE_MM).length for part in get_parts(gap))
