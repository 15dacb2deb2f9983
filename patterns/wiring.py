"""Several circuits in one hoop: each its own wire and terminals, laid one after the other."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import chain

import numpy as np

from patterns.circuit import Circuit, Crossing, CrossingKind
from patterns.errors import PatternError
from patterns.exits import exits
from patterns.groups import Group, check_groups, part_layout
from patterns.layout import ROUNDED_MM, Layout, check_spaced
from patterns.spanning_tree import fewest_stages_tree
from patterns.tails import Exit
from patterns.tangent_switch import single_circuit
from patterns.touching import touching
from patterns.wire_index import WireIndex


@dataclass(frozen=True, kw_only=True)
class Wiring(Circuit):
    """Circuits as one: the stages of all in laying order; made by `several_wires`.

    Places along the wire count through all circuits, as if the end of one wire were the start of
    the next. The crossings hold those of each circuit, and a contact wherever loops of two circuits
    touch: there the wire of the earlier circuit is covered before the later one is laid.

    Attributes
    ----------
    circuits : tuple of Circuit
        Each over its own loops.
    groups : tuple of Group
        Name and loops of each.
    """

    circuits: tuple[Circuit, ...]
    groups: tuple[Group, ...]

    @property
    def parts(self) -> tuple[Circuit, ...]:
        """The circuits, in laying order."""
        return self.circuits

    @property
    def part_names(self) -> tuple[str, ...]:
        """The names of the groups."""
        return tuple(group.name for group in self.groups)

    @property
    def part_loops(self) -> tuple[tuple[int, ...], ...]:
        """The loops of the groups."""
        return tuple(group.loops for group in self.groups)

    @property
    def closed(self) -> bool:
        """Whether every wire, its tails taken off, is a closed curve."""
        return all(circuit.closed for circuit in self.circuits)

    def stage_name(self, stage: int) -> str:
        """Name a stage and its circuit."""
        part = self.part_of_stage[stage]
        own = stage - self.part_of_stage.index(part)
        return f"stage {own + 1} of circuit {self.groups[part].name}"


def several_wires(
    layout: Layout,
    groups: tuple[Group, ...],
    tail_length_mm: float,
    smallest_bends_mm: tuple[float, ...],
) -> Wiring:
    """Run one wire through each group of loops, each in as few stages as are found.

    Parameters
    ----------
    groups
        In the order in which their wires are laid.
    tail_length_mm
        Length of the straight part of each tail.
    smallest_bends_mm
        For each group the smallest bend radius of its wire.

    Raises
    ------
    PatternError
        When loops nearly touch, a loop is in no group or in two, the loops of a group are apart,
        or tails cannot leave without crossing other wire.
    """
    if not layout.loops:
        raise PatternError("there is no loop: nothing is left of the array")
    check_spaced(layout)
    check_groups(layout, groups)
    places = exits(layout, groups, tail_length_mm, smallest_bends_mm)
    return wires_from(layout, groups, places, tail_length_mm)


def wires_from(
    layout: Layout, groups: tuple[Group, ...], places: tuple[Exit, ...], tail_length_mm: float
) -> Wiring:
    """Run one wire through each group of loops whose tails leave at given places.

    Parameters
    ----------
    places
        One a group; loops are indices into ``layout.loops``.
    """
    circuits = tuple(
        _circuit(layout, group, place, tail_length_mm)
        for group, place in zip(groups, places, strict=True)
    )
    return wiring_of(layout, groups, circuits)


def _circuit(layout: Layout, group: Group, place: Exit, tail_length_mm: float) -> Circuit:
    own = part_layout(layout, group.loops)
    loop = group.loops.index(place.loop)
    switches = fewest_stages_tree(touching(own), loop, place.angle_rad)
    start = (loop, place.angle_rad, tail_length_mm)
    further = _contacts_with_others(layout, group)
    return single_circuit(own, switches, *start, bend_mm=place.bend_mm, further_mm=further)


def _contacts_with_others(layout: Layout, group: Group) -> list[tuple[float, float]]:
    """Points in which loops of a group touch loops outside it."""
    own = set(group.loops)
    return [(c.x_mm, c.y_mm) for c in layout.contacts if (c.first in own) != (c.second in own)]


def wiring_of(layout: Layout, groups: tuple[Group, ...], circuits: tuple[Circuit, ...]) -> Wiring:
    """Put circuits together, each over the loops of its group."""
    lengths = np.array([circuit.wire_length_mm for circuit in circuits])
    starts = (np.cumsum(lengths) - lengths).tolist()
    index = {(c.first, c.second): k for k, c in enumerate(layout.contacts)}
    switches = [
        index[group.loops[own.first], group.loops[own.second]]
        for group, circuit in zip(groups, circuits, strict=True)
        for own in (circuit.layout.contacts[k] for k in circuit.switches)
    ]
    moved = (
        replace(one, first_mm=one.first_mm + start, second_mm=one.second_mm + start)
        for circuit, start in zip(circuits, starts, strict=True)
        for one in circuit.crossings
    )
    return Wiring(
        layout,
        tuple(sorted(switches)),
        tuple(chain.from_iterable(circuit.stages for circuit in circuits)),
        (*moved, *_between(layout, groups, circuits, starts)),
        circuits=circuits,
        groups=groups,
    )


def _between(
    layout: Layout, groups: tuple[Group, ...], circuits: tuple[Circuit, ...], starts: list[float]
) -> Iterator[Crossing]:
    """Contacts of loops that lie in different circuits."""
    circuit_of = {loop: k for k, group in enumerate(groups) for loop in group.loops}
    meeting = [c for c in layout.contacts if circuit_of[c.first] != circuit_of[c.second]]
    if not meeting:
        return
    wires = [WireIndex(circuit.wire) for circuit in circuits]
    for contact in meeting:
        first, second = sorted((circuit_of[contact.first], circuit_of[contact.second]))
        point = np.array([[contact.x_mm, contact.y_mm]])
        at = [
            starts[k] + float(wires[k].nearest(point, 10 * ROUNDED_MM).station_mm[0])
            for k in (first, second)
        ]
        yield Crossing(CrossingKind.CONTACT, contact.x_mm, contact.y_mm, at[0], at[1])
