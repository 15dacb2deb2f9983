"""In which contacts the wire changes loop: the tree that needs the fewest stages."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import pairwise
from math import hypot, pi, tau

from patterns.exchange import exchanged
from patterns.splits import stage_count
from patterns.touching import Touching

EVENTS = 600_000
"""Contacts that the search may pass: it bounds the time, whatever the size of the array."""

_SAME_MM = 1e-6
_CORNERS_OF_A_HOLE = 3

_Choice = tuple[float, int, int]
"""Angle of a contact on the loop, the contact, and the loop beyond."""

_Preference = Callable[[float, _Choice, set[int]], tuple[float, ...]]
"""From the angle of arrival, a choice and the loops reached so far to its rank, lowest first."""


def fewest_stages_tree(graph: Touching, loop: int, start_rad: float) -> tuple[int, ...]:
    """Choose a spanning tree of the touching graph.

    Whatever the tree, the wire passes every contact twice and goes once around every loop: each
    contact needs one cover, and the wire is as long as the loops are around, and its tails. What
    the tree decides is in how many stages it is laid.

    Every leaf of the tree needs a split of its own, for the wire passes its one switch twice while
    it goes around the leaf, so trees of few branches are tried: serpentines along both axes,
    spirals, and the way into the narrowest place. If none is as good as can be, the best is
    improved by exchanges. Of equally many stages the tree with the shortest way for the cover
    thread is taken.

    Parameters
    ----------
    graph
        A touching graph in one piece.
    loop, start_rad
        Where the wire sets out.

    Returns
    -------
    tuple of int
        Contacts, in rising order. Deterministic.
    """
    least = _least_stages(graph)
    best: tuple[int, float, tuple[int, ...]] | None = None
    for tree in _candidates(graph, loop, start_rad):
        tour = graph.tour(set(tree), loop, start_rad)
        stages = stage_count(tour)
        if stages == least:
            return tree
        rated = (stages, _cover_travel_mm(graph, tour), tree)
        best = rated if best is None else min(best, rated)
    if best is None:
        return ()
    tries = EVENTS // (2 * len(graph.layout.contacts))
    improved = exchanged(graph, best[2], loop, start_rad, tries=tries, least=least)
    tour = graph.tour(set(improved), loop, start_rad)
    return min(best, (stage_count(tour), _cover_travel_mm(graph, tour), improved))[2]


def _least_stages(graph: Touching) -> int:
    """Fewest stages there can be.

    Around a hole between three touching loops three stages meet, unless a split lies beside it.
    With two stages there is one split, and the terminals lie outside.
    """
    beside = [set(own.values()) for own in graph.beyond]
    corners = sum(
        len(beside[contact.first] & beside[contact.second]) for contact in graph.layout.contacts
    )
    return 3 if corners > _CORNERS_OF_A_HOLE else 2


def _candidates(graph: Touching, loop: int, start_rad: float) -> Iterator[tuple[int, ...]]:
    if not graph.layout.contacts:
        return
    for preference in _preferences(graph):
        yield _deep_tree(graph, loop, start_rad, preference)


def _preferences(graph: Touching) -> Iterator[_Preference]:
    loops = graph.layout.loops

    def sweep(x: float, y: float) -> _Preference:
        def rank(arrival: float, choice: _Choice, _: set[int]) -> tuple[float, ...]:
            beyond = loops[choice[2]]
            along = x * beyond.x_mm + y * beyond.y_mm
            return round(along / _SAME_MM) * _SAME_MM, abs(_turn(arrival, choice) - pi)

        return rank

    yield from (sweep(0, 1), sweep(1, 0), sweep(0, -1), sweep(-1, 0))
    yield lambda arrival, choice, _: (_turn(arrival, choice),)
    yield lambda arrival, choice, _: (-_turn(arrival, choice),)
    yield lambda arrival, choice, reached: (
        len(set(graph.beyond[choice[2]].values()) - reached),
        _turn(arrival, choice),
    )


def _turn(arrival_rad: float, choice: _Choice) -> float:
    """Angle from where the way comes in, counter-clockwise to where it goes on."""
    return (choice[0] - arrival_rad) % tau


def _deep_tree(
    graph: Touching, loop: int, start_rad: float, preference: _Preference
) -> tuple[int, ...]:
    """Go on to the preferred loop not yet reached; from a dead end go back."""
    reached, tree = {loop}, list[int]()
    way = [(loop, start_rad)]
    while way:
        here, arrival = way[-1]
        open_ways = [
            (angle, contact, graph.beyond[here][contact])
            for contact, angle in graph.angle_rad[here].items()
            if graph.beyond[here][contact] not in reached
        ]
        if not open_ways:
            way.pop()
            continue
        chosen = min(open_ways, key=lambda choice: preference(arrival, choice, reached))
        _, contact, beyond = chosen
        reached.add(beyond)
        tree.append(contact)
        way.append((beyond, graph.angle_rad[beyond][contact]))
    return tuple(sorted(tree))


def _cover_travel_mm(graph: Touching, tour: list[int]) -> float:
    """Way of the cover thread from contact to contact, were all covered in the order of laying."""
    contacts = [graph.layout.contacts[k] for k in dict.fromkeys(tour)]
    steps = (hypot(b.x_mm - a.x_mm, b.y_mm - a.y_mm) for a, b in pairwise(contacts))
    return round(sum(steps), 6)
