"""Which contacts lie on each loop, in order, and how a wire tours them."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from math import hypot, tau

from patterns.errors import PatternError
from patterns.layout import Layout

CLOCKWISE = -1

SAME_POINT_MM = 1e-3
"""The start point is at least this far from every contact."""


@dataclass(frozen=True, slots=True)
class Touching:
    """The contacts on every loop; made by `touching`.

    Attributes
    ----------
    layout : Layout
    angle_rad : tuple of dict
        For each loop the direction (0 to 2 pi) of its outward normal in each of its contacts, in
        rising order.
    left, right : tuple of dict
        For each loop the contact that follows each contact counter-clockwise, and clockwise.
    beyond : tuple of dict
        For each loop the loop on the other side of each contact.
    """

    layout: Layout
    angle_rad: tuple[dict[int, float], ...]
    left: tuple[dict[int, int], ...]
    right: tuple[dict[int, int], ...]
    beyond: tuple[dict[int, int], ...]

    def first_contact(self, loop: int, start_rad: float) -> int | None:
        """Contact that a wire which sets out clockwise reaches first; none on a loop by itself."""
        angles = self.angle_rad[loop]
        return min(angles, key=lambda k: (start_rad - angles[k]) % tau, default=None)

    def tour(self, switches: Collection[int], loop: int, start_rad: float) -> list[int]:
        """Contacts in the order in which the wire passes them, each twice.

        Parameters
        ----------
        switches
            A spanning tree: the contacts in which the wire changes loop (best a set).
        loop, start_rad
            Where the wire sets out, clockwise.
        """
        contact = self.first_contact(loop, start_rad)
        if contact is None:
            return []
        passed: list[int] = []
        onward, back = self.right, self.left
        for _ in range(2 * len(self.layout.contacts)):
            passed.append(contact)
            if contact in switches:
                loop = self.beyond[loop][contact]
                onward, back = back, onward
            contact = onward[loop][contact]
        return passed


def touching(layout: Layout) -> Touching:
    """List the contacts on every loop."""
    angle: list[dict[int, float]] = [{} for _ in layout.loops]
    beyond: list[dict[int, int]] = [{} for _ in layout.loops]
    for k, contact in enumerate(layout.contacts):
        for here, there in (
            (contact.first, contact.second),
            (contact.second, contact.first),
        ):
            angle[here][k] = layout.loops[here].normal_rad(contact.x_mm, contact.y_mm)
            beyond[here][k] = there
    ordered = tuple(dict(sorted(own.items(), key=lambda item: item[1])) for own in angle)
    left = tuple(_following(list(own)) for own in ordered)
    right = tuple(_following(list(own)[::-1]) for own in ordered)
    return Touching(layout, ordered, left, right, tuple(beyond))


def check_start(graph: Touching, loop: int, start_rad: float) -> None:
    """Refuse a start point on a contact."""
    x, y = graph.layout.loops[loop].point_mm(start_rad)
    for contact in graph.angle_rad[loop]:
        place = graph.layout.contacts[contact]
        if hypot(place.x_mm - x, place.y_mm - y) < SAME_POINT_MM:
            raise PatternError(
                f"the start point on loop {loop} is the contact {contact}: "
                f"the tails would cross another loop there; choose another angle"
            )


def _following(ring: list[int]) -> dict[int, int]:
    return dict(zip(ring, ring[1:] + ring[:1], strict=True))
