"""Loops that share a wire: which of them each circuit runs through."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import networkx as nx

from patterns.errors import PatternError
from patterns.layout import Contact, Layout, nearest_pair_text
from patterns.terminals import Side


@dataclass(frozen=True, slots=True)
class Group:
    """The loops of one circuit.

    Attributes
    ----------
    name : str
        What the operator calls the circuit.
    loops : tuple of int
        Indices into `Layout.loops`, in rising order.
    side : Side
        Where the tails leave.
    anywhere : bool
        Whether they may leave on another side when there is no place on that one.
    """

    name: str
    loops: tuple[int, ...]
    side: Side = Side.CORNER
    anywhere: bool = False


def touching_groups(layout: Layout) -> tuple[tuple[int, ...], ...]:
    """Put loops together to which touching loops lead, in the order of their first loops."""
    graph: nx.Graph[int] = nx.Graph()
    graph.add_nodes_from(range(len(layout.loops)))
    graph.add_edges_from((contact.first, contact.second) for contact in layout.contacts)
    return tuple(sorted(tuple(sorted(group)) for group in nx.connected_components(graph)))


def part_layout(layout: Layout, loops: tuple[int, ...]) -> Layout:
    """Give some loops of a layout as one of their own, with the contacts among them."""
    place = {loop: k for k, loop in enumerate(loops)}
    contacts = (
        Contact(place[c.first], place[c.second], c.x_mm, c.y_mm)
        for c in layout.contacts
        if c.first in place and c.second in place
    )
    return Layout(tuple(layout.loops[k] for k in loops), tuple(contacts))


def check_groups(layout: Layout, groups: tuple[Group, ...]) -> None:
    """Refuse groups that do not hold every loop once, or in which loops are apart.

    Raises
    ------
    PatternError
        With the circuits and loops by name and number.
    """
    for group in groups:
        wrong = [k for k in group.loops if not 0 <= k < len(layout.loops)]
        if wrong:
            raise PatternError(
                f"circuit {group.name}: there is no loop {wrong[0]}: "
                f"the loops are counted from 0 to {len(layout.loops) - 1}"
            )
        if not group.loops:
            raise PatternError(f"circuit {group.name}: it has no loops")
    times = Counter(loop for group in groups for loop in group.loops)
    for loop in range(len(layout.loops)):
        if times[loop] != 1:
            raise PatternError(_not_once(layout, groups, loop))
    for group in groups:
        _check_joined(layout, group)


def _not_once(layout: Layout, groups: tuple[Group, ...], loop: int) -> str:
    own = [group.name for group in groups if loop in group.loops]
    place = f"loop {loop} at ({layout.loops[loop].x_mm:g}, {layout.loops[loop].y_mm:g}) mm"
    if not own:
        return f"{place} is in no circuit: every loop must be in one"
    twice = f"circuits {', '.join(own)}" if len(own) > 1 else f"circuit {own[0]} twice"
    return f"{place} is in {twice}: every loop must be in one circuit, once"


def _check_joined(layout: Layout, group: Group) -> None:
    first, *others = touching_groups(part_layout(layout, group.loops))
    if others:
        near = [group.loops[k] for k in first]
        far = [group.loops[k] for other in others for k in other]
        raise PatternError(
            f"circuit {group.name}: one wire cannot run through all of its loops, for "
            f"{len(far)} of {len(group.loops)} are apart from loop {near[0]}; "
            f"{nearest_pair_text(layout.loops, near, far)}"
        )
