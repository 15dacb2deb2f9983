"""Circuits that lie side by side, joined in series: one wire through all of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import chain, pairwise
from math import atan2, copysign, hypot, pi

import numpy as np

from patterns.circuit import Circuit, Crossing
from patterns.errors import PatternError
from patterns.groups import part_layout
from patterns.layout import Layout
from patterns.path import Arc, Piece, WirePath

_ROUNDOFF_MM = 1e-6


def in_series(
    layout: Layout,
    circuits: Sequence[Circuit],
    loops: Sequence[tuple[int, ...]],
    smallest_bend_mm: float,
) -> Circuit:
    """Run one wire through circuits whose tails all leave in one direction, side by side.

    Where one wire would leave it turns back on half a circle into the next circuit. The stage that
    ends one circuit begins the next, so that n circuits of two stages each make n + 1 stages.

    Parameters
    ----------
    layout
        That of all loops.
    circuits
        In the order in which the wire runs through them. Each tail is a bend and then a line.
    loops
        The loops of each, as rising indices into ``layout.loops``.
    smallest_bend_mm
        Smallest bend radius of the wire.

    Raises
    ------
    PatternError
        When the tails of neighbours are too near to each other for such a bend.
    """
    turns = [_turn(one, other, smallest_bend_mm) for one, other in pairwise(circuits)]
    together = tuple(sorted(chain.from_iterable(loops)))
    own = part_layout(layout, together)
    return Circuit(
        own,
        tuple(sorted(_switches(own, together, circuits, loops))),
        _stages(circuits, turns),
        tuple(_crossings(circuits, turns)),
        circuits[0].tail_pieces,
        tuple(
            WirePath((one.stages[-1].pieces[-2], turn, other.stages[0].pieces[1]))
            for (one, other), turn in zip(pairwise(circuits), turns, strict=True)
        ),
    )


def _turn(one: Circuit, other: Circuit, smallest_mm: float) -> Arc:
    """Half a circle from the bend on which a wire leaves to that on which the next comes."""
    (x, y), (along_x, along_y) = _at(one.stages[-1].pieces[-1])
    (next_x, next_y), _ = _at(other.stages[0].pieces[1])
    over_x, over_y = next_x - x, next_y - y
    radius = hypot(over_x, over_y) / 2
    if abs(over_x * along_x + over_y * along_y) > _ROUNDOFF_MM:
        raise PatternError("circuits cannot be joined: their tails do not leave side by side")
    if radius < smallest_mm:
        raise PatternError(
            f"circuits cannot be joined: between their tails, {2 * radius:.4g} mm apart at "
            f"({x:.1f}, {y:.1f}) mm, the wire would bend with a radius of {radius:.4g} mm, less "
            f"than {smallest_mm:g} mm: lay them farther apart"
        )
    sweep = copysign(pi, along_x * over_y - along_y * over_x)
    centre = x + over_x / 2, y + over_y / 2
    return Arc(*centre, radius, atan2(-over_y, -over_x), sweep)


def _at(piece: Piece) -> tuple[list[float], list[float]]:
    """Where a piece begins, and its direction there."""
    points, tangents = piece.at(np.zeros(1))
    return points[0].tolist(), tangents[0].tolist()


def _switches(
    layout: Layout,
    together: tuple[int, ...],
    circuits: Sequence[Circuit],
    loops: Sequence[tuple[int, ...]],
) -> Iterator[int]:
    """Find each circuit's switches among the contacts of the joined one's layout."""
    index = {(together[c.first], together[c.second]): k for k, c in enumerate(layout.contacts)}
    for circuit, own in zip(circuits, loops, strict=True):
        for contact in (circuit.layout.contacts[k] for k in circuit.switches):
            yield index[own[contact.first], own[contact.second]]


def _stages(circuits: Sequence[Circuit], turns: Sequence[Arc]) -> tuple[WirePath, ...]:
    stages = [*circuits[0].stages]
    for circuit, turn in zip(circuits[1:], turns, strict=True):
        before, after = stages[-1].pieces[:-1], circuit.stages[0].pieces[1:]
        stages[-1] = WirePath((*before, turn, *after))
        stages += circuit.stages[1:]
    return tuple(stages)


def _crossings(circuits: Sequence[Circuit], turns: Sequence[Arc]) -> list[Crossing]:
    """Crossings of each circuit, where they lie along the joined wire."""
    shifts = [0.0]
    for (one, other), turn in zip(pairwise(circuits), turns, strict=True):
        left_out = one.stages[-1].pieces[-1].length_mm + other.stages[0].pieces[0].length_mm
        shifts.append(shifts[-1] + one.wire_length_mm + turn.length_mm - left_out)
    return [
        replace(one, first_mm=one.first_mm + shift, second_mm=one.second_mm + shift)
        for circuit, shift in zip(circuits, shifts, strict=True)
        for one in circuit.crossings
    ]
