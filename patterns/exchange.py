"""Improvement of a spanning tree by exchanging one contact at a time."""

from __future__ import annotations

from math import exp
from random import Random

from patterns.splits import stage_count
from patterns.touching import Touching

_WARMTH = 0.3
"""At first an exchange that costs one stage more is accepted with the chance exp(-1 / this)."""


class _Tree:
    """A spanning tree that is changed in place."""

    def __init__(self, graph: Touching, switches: tuple[int, ...]) -> None:
        self.graph = graph
        self.switches = set(switches)
        self.at = [{k for k in own if k in self.switches} for own in graph.beyond]

    def swap(self, out: int, into: int) -> None:
        """Take one contact out and another in."""
        for contact, change in ((out, set[int].discard), (into, set[int].add)):
            change(self.switches, contact)
            ends = self.graph.layout.contacts[contact]
            change(self.at[ends.first], contact)
            change(self.at[ends.second], contact)

    def ring_of(self, contact: int) -> list[int]:
        """Switches of the ring that a further contact would close, from one end to the other."""
        ends = self.graph.layout.contacts[contact]
        came: dict[int, tuple[int, int]] = {ends.first: (ends.first, -1)}
        front = [ends.first]
        for loop in front:
            if loop == ends.second:
                break
            for switch in self.at[loop]:
                beyond = self.graph.beyond[loop][switch]
                if beyond not in came:
                    came[beyond] = loop, switch
                    front.append(beyond)
        ring: list[int] = []
        loop = ends.second
        while loop != ends.first:
            loop, switch = came[loop]
            ring.append(switch)
        return ring


def exchanged(
    graph: Touching,
    switches: tuple[int, ...],
    loop: int,
    start_rad: float,
    *,
    tries: int,
    least: int,
) -> tuple[int, ...]:
    """Look for a tree of fewer stages by annealing: exchanges that cost little are accepted, first.

    A contact outside of the tree closes a ring; one switch of the ring is opened instead, mostly
    one beside the new contact, which turns a path into another path.

    Parameters
    ----------
    switches
        The tree to begin with.
    loop, start_rad
        Where the wire sets out.
    tries
        How many trees are looked at.
    least
        So many stages are as few as can be: the search ends there.

    Returns
    -------
    tuple of int
        The best tree found, in rising order; the same every time.
    """
    chance = Random(0).random
    tree = _Tree(graph, switches)
    outside = [k for k in range(len(graph.layout.contacts)) if k not in tree.switches]
    best, now = tuple(sorted(switches)), stage_count(graph.tour(tree.switches, loop, start_rad))
    fewest = now
    for tried in range(tries if outside else 0):
        place = int(chance() * len(outside))
        into = outside[place]
        ring = tree.ring_of(into)
        opened = (ring[0], ring[-1], ring[int(chance() * len(ring))])[int(chance() * 3)]
        tree.swap(opened, into)
        stages = stage_count(graph.tour(tree.switches, loop, start_rad))
        warmth = _WARMTH * (1 - tried / tries)
        if stages > now and chance() >= exp((now - stages) / warmth):
            tree.swap(into, opened)
            continue
        now, outside[place] = stages, opened
        if now < fewest:
            fewest, best = now, tuple(sorted(tree.switches))
            if fewest <= least:
                break
    return best
