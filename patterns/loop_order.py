"""In which order the wire reaches the loops."""

from __future__ import annotations

import shapely

from patterns.circuit import Circuit
from patterns.path import Arc

_SAME_CENTRE_MM = 1e-3


def loops_in_order(circuit: Circuit) -> tuple[int, ...]:
    """Give the loops in the order in which the wire reaches them, stage by stage."""
    loops = shapely.STRtree(shapely.points([(one.x_mm, one.y_mm) for one in circuit.layout.loops]))
    # the bend of a tail is an arc about no loop's centre
    arcs = [piece for piece in circuit.wire.pieces if isinstance(piece, Arc)]
    centres = shapely.points([(arc.centre_x_mm, arc.centre_y_mm) for arc in arcs])
    _, reached = loops.query_nearest(centres, max_distance=_SAME_CENTRE_MM)
    return tuple(dict.fromkeys(reached.tolist()))
