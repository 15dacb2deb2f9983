"""The couching of every stage of a circuit."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from patterns.centreline import swung_couching
from patterns.circuit import Circuit
from patterns.couching import FREE_TAIL_MM, LEFT, RIGHT, couching
from patterns.laid_wire import LaidWire
from patterns.machine import Machine
from patterns.path import Vectors, WirePath
from patterns.stations import Lengths
from patterns.stitching import Stitching


def tied_down(
    circuit: Circuit,
    laid: Sequence[LaidWire],
    *,
    clear_mm: Sequence[float],
    machine: Machine,
    stitching: Stitching,
) -> list[Vectors]:
    """Tie down the stages, a stitch square over the wire in every crossing.

    Parameters
    ----------
    laid
        For each stage the wire that lies there when it is tied down, its own included, with
        distances as if all of it were as thick as its own.
    clear_mm
        Smallest distance of the needle from a centreline, for the wire of each stage.

    Returns
    -------
    list of Vectors
        For each stage what the file holds of its couching, (n, 2) in mm. The free ends of the tails
        are not tied down.

    Raises
    ------
    PatternError
        As `patterns.couching.couching` and `patterns.centreline.swung_couching`.
    """
    tied: list[Vectors] = []
    for stage, wire in enumerate(circuit.stages):
        begins = circuit.begins_wire(stage)
        begin = FREE_TAIL_MM if begins else 0.0
        end = wire.length_mm - (FREE_TAIL_MM if circuit.ends_wire(stage) else 0.0)
        span, junctions = (begin, end), junctions_mm(circuit, stage)
        if machine.couching == "centreline":
            points = swung_couching(
                wire,
                span,
                laid[stage],
                clear_mm=clear_mm[stage],
                swing_mm=machine.swing_mm,
                stitching=stitching,
                junctions_mm=junctions,
            )
        else:
            points = couching(
                wire,
                span,
                # Not into the last hole of the stage before, whose lock it would loosen.
                LEFT if begins else _other_side(wire, tied[-1][-1]),
                laid[stage],
                clear_mm=clear_mm[stage],
                stitching=stitching,
                junctions_mm=junctions,
            )
        tied.append(points)
    return tied


def junctions_mm(circuit: Circuit, stage: int) -> Lengths:
    """Where along a stage (n,) it passes the crossings, in order."""
    passed = np.array([[c.first_mm, c.second_mm] for c in circuit.crossings]).ravel()
    along = passed - circuit.starts_mm[stage]
    return np.sort(along[(along > 0) & (along < circuit.stages[stage].length_mm)])


def _other_side(wire: WirePath, needle_mm: Vectors) -> float:
    """Side of a wire's start on which a needle point does not lie."""
    point, tangent = wire.at(0.0)
    (x, y), (tx, ty) = needle_mm - point[0], tangent[0]
    return RIGHT if tx * y - ty * x > 0 else LEFT
