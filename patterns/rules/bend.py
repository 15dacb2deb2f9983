"""The wire is laid without kinks and without bends that break it."""

from __future__ import annotations

import numpy as np

from patterns.path import WirePath
from patterns.rules.subject import Subject
from patterns.violation import Violation

_LARGEST_GAP_MM = 1e-3
_LARGEST_KINK = 1e-3
_ROUND_OFF = 1e-6


def check_bend_radius(subject: Subject) -> list[Violation]:
    """No bend is tighter than the smallest radius, in wire diameters, that the settings give."""
    message = "the wire is bent too tightly: radius"
    faults: list[Violation] = []
    for piece, stage in zip(subject.circuit.wire.pieces, subject.stage_of_piece, strict=True):
        allowed = subject.stitching.smallest_bend_diameters * subject.diameters_mm[stage]
        if abs(piece.curvature_per_mm) * allowed > 1 + _ROUND_OFF:
            middle, _ = piece.at(np.array([piece.length_mm / 2]))
            radius = 1 / abs(piece.curvature_per_mm)
            x, y = (float(value) for value in middle[0])
            faults.append(Violation("bend-radius", message, x, y, actual=radius, allowed=allowed))
    return faults


def check_smooth_path(subject: Subject) -> list[Violation]:
    """From terminal to terminal each wire has no jump and no kink, within and between stages."""
    return [fault for part in subject.circuit.parts for fault in _check_smooth(part.wire)]


def _check_smooth(wire: WirePath) -> list[Violation]:
    pieces = wire.pieces
    gaps, kinks = wire.joints()
    faults: list[Violation] = []
    for i in np.flatnonzero((gaps > _LARGEST_GAP_MM) | (kinks > _LARGEST_KINK)):
        start, _ = pieces[int(i) + 1].at(np.array([0.0]))
        x, y = (float(value) for value in start[0])
        gap, kink = float(gaps[i]), float(np.degrees(2 * np.arcsin(min(kinks[i] / 2, 1.0))))
        message = f"the wire jumps by {gap:.3f} mm and turns by {kink:.1f} degrees"
        faults.append(Violation("smooth-path", message, x, y))
    return faults
