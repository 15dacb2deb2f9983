"""The holes of the couching do not run into one another."""

from __future__ import annotations

import numpy as np

from patterns.rules.couched import Couched, couched
from patterns.rules.subject import Subject
from patterns.violation import Violation

_ROUNDOFF_MM = 1e-9


def check_couching_holes(subject: Subject) -> list[Violation]:
    """Two needle points after one another on one side are a needle's diameter apart.

    Nearer, their holes are one, and the thread holds nothing. The small stitches of locks, which
    carry no wire, do not count.
    """
    return [fault for couching in couched(subject) for fault in _too_near(couching)]


def _too_near(couching: Couched) -> list[Violation]:
    needles = couching.needles_mm
    apart = np.hypot(*(needles[2:] - needles[:-2]).T)
    allowed = couching.subject.machine.needle_diameter_mm
    message = "the couching is too close: its holes on one side run together, distance"
    return [
        couching.fault("couching-holes", int(i) + 2, message, float(apart[i]), allowed)
        for i in np.flatnonzero(apart < allowed - _ROUNDOFF_MM)
    ]
