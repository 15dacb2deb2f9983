"""In which order the wire reaches the loops."""

from __future__ import annotations

import numpy as np
import shapely

from patterns.circuit import Circuit
from patterns.layout import Layout
from patterns.path import Arc, Vectors


def loops_in_order(circuit: Circuit) -> tuple[int, ...]:
    """Give the loops in the order in which the wire reaches them, stage by stage."""
    bent = [part for part in circuit.parts if part.tail_pieces > 1]
    paths = (path for part in bent for path in (*part.tails, *part.links))
    bends = {piece for path in paths for piece in path.pieces}
    arcs = [one for one in circuit.wire.pieces if isinstance(one, Arc) and one not in bends]
    # from no bend of a loop does so short a way inward lead out of the loop again
    inward_mm = min(loop.smallest_radius_mm for loop in circuit.layout.loops)
    place, loop = _holding(circuit.layout, np.array([_beside(arc, inward_mm) for arc in arcs]))
    return tuple(dict.fromkeys(loop[np.argsort(place, kind="stable")].tolist()))


def _beside(arc: Arc, inward_mm: float) -> tuple[float, float]:
    """Point beside the middle of an arc, on its inside."""
    angle = arc.start_rad + arc.sweep_rad / 2
    out = arc.radius_mm - inward_mm
    return arc.centre_x_mm + out * np.cos(angle), arc.centre_y_mm + out * np.sin(angle)


def _holding(layout: Layout, points_mm: Vectors) -> tuple[np.ndarray, np.ndarray]:
    """Points, and the loop that holds each."""
    boxes = shapely.box(*np.array([loop.box_mm() for loop in layout.loops]).T)
    place, loop = shapely.STRtree(boxes).query(shapely.points(points_mm))
    held = [
        layout.loops[k].holds(*points_mm[n])
        for n, k in zip(place.tolist(), loop.tolist(), strict=True)
    ]
    return place[held], loop[held]
