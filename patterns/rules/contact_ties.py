"""Neighbouring loops are tied together where they touch, if that is asked for."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from shapely import STRtree, points

from patterns.layout import Contact
from patterns.path import Vectors
from patterns.plan import UNITS_PER_MM, BlockKind
from patterns.rules.subject import Subject
from patterns.stitching import ROUNDING_MM
from patterns.violation import Violation

_RULE = "contact-ties"
_OFF_MM = 2 * ROUNDING_MM
"""How far rounding of both of its holes can move a tie from its contact."""


def check_contact_ties(subject: Subject) -> list[Violation]:
    """Every contact has a tie, which leads over it from inside one loop to inside the other.

    A tie that holds no contact is a fault too.
    """
    contacts = subject.circuit.layout.contacts
    blocks = [k for k, b in enumerate(subject.plan.blocks) if b.kind is BlockKind.TIES]
    if subject.stitching.ties == "none" or not contacts or not blocks:
        return []  # a missing block is another rule's matter
    places = STRtree(points([(contact.x_mm, contact.y_mm) for contact in contacts]))
    tied: set[int] = set()
    faults: list[Violation] = []
    for block in blocks:
        start = 0
        for run in subject.plan.blocks[block].runs:
            if not len(run.needles):
                continue
            needles = run.needles / UNITS_PER_MM
            nearest = int(places.nearest(points(needles.mean(axis=0))))
            off = _off_mm(subject, contacts[nearest], needles)
            if off <= _OFF_MM:
                tied.add(nearest)
            else:
                message = "the tie holds no contact of two loops: distance from the nearest"
                off = off if np.isfinite(off) else None
                where = {"actual": off, "allowed": None if off is None else _OFF_MM}
                faults.append(subject.fault(_RULE, message, block, start, **where))
            start += len(needles)
    return faults + [_loose(c) for k, c in enumerate(contacts) if k not in tied]


def _off_mm(subject: Subject, contact: Contact, needles_mm: Vectors) -> float:
    """How far from a contact stitches pass that lead from one of its loops into the other."""
    loops = subject.circuit.layout.loops
    place = np.array([contact.x_mm, contact.y_mm])
    first, second = (
        np.array([loops[k].holds(x, y) for x, y in needles_mm.tolist()])
        for k in (contact.first, contact.second)
    )
    over = (first[:-1] & second[1:]) | (second[:-1] & first[1:])
    return float(
        _distance_mm(place, needles_mm[:-1][over], needles_mm[1:][over]).min(initial=np.inf)
    )


def _distance_mm(place: Vectors, begin: Vectors, end: Vectors) -> NDArray[np.float64]:
    """Distance (n,) of a place from the lines through the ends (n, 2) of stitches."""
    ahead = (end - begin) / np.hypot(*(end - begin).T)[:, None]
    x, y = (place - begin).T
    return np.abs(ahead[:, 0] * y - ahead[:, 1] * x)


def _loose(contact: Contact) -> Violation:
    message = f"loops {contact.first} and {contact.second} are not tied where they touch: ties"
    return Violation(_RULE, message, contact.x_mm, contact.y_mm, actual=0.0, allowed=1.0)
