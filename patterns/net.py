"""The electrical net, from nothing but the stitches: what a short circuit would really do."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, pairwise

import networkx as nx
import numpy as np

from patterns.couching import FREE_TAIL_MM
from patterns.kirchhoff import effective_resistance_ohm
from patterns.meetings import Meeting, meetings
from patterns.plan import UNITS_PER_MM, StitchPlan
from patterns.sewn_pieces import SewnPieces
from patterns.sewn_wire import Strand, sewn_strand

JOIN_MM = 1.0
"""A strand that begins this near to the end of the wire before it continues that wire."""

_LEAST_EDGE_MM = 1e-6

Node = tuple[str, int, int]
"""A terminal (its wire and end) or a short (its number)."""


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of wire.

    Attributes
    ----------
    diameter_mm : float
    ohm_per_mm : float
    """

    diameter_mm: float
    ohm_per_mm: float


@dataclass(frozen=True)
class SewnNet:
    """Wires and the places in which they come together; made by `sewn_net`.

    Attributes
    ----------
    wires : tuple of tuples of Strand
        The strands of each wire, end to end.
    kinds : tuple of Kind
        Of each wire.
    meetings : tuple of Meeting
        Where strands come within contact of one another.
    """

    wires: tuple[tuple[Strand, ...], ...]
    kinds: tuple[Kind, ...]
    meetings: tuple[Meeting, ...]

    @property
    def shorts(self) -> tuple[Meeting, ...]:
        """Places in which no cover lies between two passes of wire."""
        return tuple(one for one in self.meetings if not one.insulated)

    @cached_property
    def wire_of(self) -> dict[int, tuple[int, float]]:
        """For the block of each strand its wire, and where along the wire it begins."""
        found: dict[int, tuple[int, float]] = {}
        for wire, strands in enumerate(self.wires):
            begin = FREE_TAIL_MM
            for strand in strands:
                found[strand.block] = wire, begin
                begin += float(strand.station_mm[-1])
        return found

    def length_mm(self, wire: int) -> float:
        """Length of a wire with the ends of its tails that no stitch holds."""
        return 2 * FREE_TAIL_MM + sum(float(one.station_mm[-1]) for one in self.wires[wire])

    @cached_property
    def graph(self) -> nx.MultiGraph[Node]:
        """Terminals and shorts, with the wire between them as resistances in ohm."""
        graph: nx.MultiGraph[Node] = nx.MultiGraph()
        for wire, kind in enumerate(self.kinds):
            stops = sorted(self._stops(wire))
            graph.add_nodes_from(node for _, node in stops)
            for (begin, here), (end, there) in pairwise(stops):
                ohm = max(end - begin, _LEAST_EDGE_MM) * kind.ohm_per_mm
                graph.add_edge(here, there, ohm=ohm)
        return graph

    def _stops(self, wire: int) -> Iterator[tuple[float, Node]]:
        """Places along a wire at which something is joined to it."""
        yield 0.0, ("terminal", wire, 0)
        yield self.length_mm(wire), ("terminal", wire, 1)
        for number, short in enumerate(self.shorts):
            for block, station in ((short.under, short.under_mm), (short.over, short.over_mm)):
                of, begin = self.wire_of[block]
                if of == wire:
                    yield begin + station, ("short", number, 0)

    def resistance_ohm(self, wire: int) -> float | None:
        """Resistance between the terminals of a wire, with all shorts.

        None when there are too many shorts to tell.
        """
        ends = ("terminal", wire, 0), ("terminal", wire, 1)
        return effective_resistance_ohm(self.graph, *ends)

    def bridged(self) -> tuple[tuple[int, int], ...]:
        """Pairs of wires that shorts join."""
        group: dict[Node, int] = {}
        for number, nodes in enumerate(nx.connected_components(self.graph)):
            group.update(dict.fromkeys(nodes, number))
        of = [group["terminal", wire, 0] for wire in range(len(self.wires))]
        return tuple((a, b) for a, b in combinations(range(len(of)), 2) if of[a] == of[b])


def sewn_net(plan: StitchPlan, kinds: tuple[Kind, ...], largest_gap_mm: float) -> SewnNet:
    """Rebuild wires and contacts from a plan's stitches alone.

    Parameters
    ----------
    kinds
        Of the wires in laying order; further wires that are found are taken to be of the last kind.
    largest_gap_mm
        Cover stitches farther apart along the wire than this insulate nothing between them.
    """
    strands: list[Strand] = []
    for k, block in enumerate(plan.blocks):
        if block.kind.is_wire and block.runs:
            needles = np.concatenate([run.needles for run in block.runs]) / UNITS_PER_MM
            earlier = SewnPieces([strand.points_mm for strand in strands])
            strands.append(sewn_strand(k, needles, earlier))
    wires = _joined(strands)
    own = tuple(kinds[min(k, len(kinds) - 1)] for k in range(len(wires)))
    diameter = {
        strand.block: kind.diameter_mm
        for wire, kind in zip(wires, own, strict=True)
        for strand in wire
    }
    followed = {b.block: a.block for wire in wires for a, b in pairwise(wire)}
    found = meetings(tuple(strands), diameter, followed, plan, largest_gap_mm)
    return SewnNet(wires, own, found)


def _joined(strands: list[Strand]) -> tuple[tuple[Strand, ...], ...]:
    """Put strands of one wire together: each begins where the one before ends."""
    wires: list[list[Strand]] = []
    for strand in strands:
        if wires and _continues(strand, wires[-1][-1]):
            wires[-1].append(strand)
        else:
            wires.append([strand])
    return tuple(map(tuple, wires))


def _continues(strand: Strand, before: Strand) -> bool:
    return float(np.hypot(*(strand.points_mm[0] - before.points_mm[-1]))) <= JOIN_MM
