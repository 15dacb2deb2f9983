"""On bends the wire is tied down often enough to follow them."""

from __future__ import annotations

import numpy as np

from patterns.path import WirePath
from patterns.rules.couched import Couched, couched
from patterns.rules.subject import Subject
from patterns.violation import Violation
from patterns.wire_index import Numbers


def check_couching_angle(subject: Subject) -> list[Violation]:
    """From one stitch to the next the wire turns by no more than the largest angle."""
    return [fault for couching in couched(subject) for fault in _turns(couching)]


def _turns(couching: Couched) -> list[Violation]:
    """Steps that are too long whatever the wire does, or lead back, are reported elsewhere."""
    path, settings = couching.subject.circuit.stages[couching.stage], couching.subject.stitching
    turn = np.diff(turned_rad(path, couching.station_mm))
    limit = np.radians(settings.couching_angle_deg)
    allowed = limit + couching.rounding_mm / path.smallest_radius_mm
    advance = np.diff(couching.station_mm)
    usual = advance <= settings.couching_interval_mm + couching.rounding_mm
    message = "the wire turns too far between two stitches: degrees"
    return [
        couching.fault(
            "couching-angle", int(i) + 1, message, float(np.degrees(turn[i])), np.degrees(limit)
        )
        for i in np.flatnonzero(usual & (turn > allowed))
    ]


def turned_rad(path: WirePath, at_mm: Numbers) -> Numbers:
    """Give the angle (n,) by which a wire has turned, either way, from its start to arclengths."""
    length = np.array([piece.length_mm for piece in path.pieces])
    curvature = np.array([abs(piece.curvature_per_mm) for piece in path.pieces])
    ends = np.concatenate([[0.0], np.cumsum(length)])
    return np.interp(at_mm, ends, np.concatenate([[0.0], np.cumsum(length * curvature)]))
