"""Covers are as wide as they are asked to be."""

from __future__ import annotations

import numpy as np

from patterns.plan import BlockKind
from patterns.rules.satin import satin_stitches
from patterns.rules.subject import Subject
from patterns.violation import Violation


def check_cover_width(subject: Subject) -> list[Violation]:
    """Satin reaches past the wire, on both sides, as far as the settings ask beyond the couching.

    A needle point nearer than half the wire and half the needle strikes the wire, which is another
    rule's fault.
    """
    clearance = np.array([subject.clearance_mm(own) for own in subject.diameters_mm])
    message = "the cover is too narrow: distance of a needle point from the middle of the wire"
    faults: list[Violation] = []
    for i, block in enumerate(subject.plan.blocks):
        if block.kind is not BlockKind.COVER or not len(subject.needles_mm[i]):
            continue
        nearest, satin = satin_stitches(subject, i)
        inside = np.append(satin, False) & np.append(False, satin)  # a stitch before and after
        reach = np.abs(nearest.side_mm)
        least = clearance[subject.stage_at(nearest.station_mm)]
        allowed = least + subject.stitching.wider_by_mm
        with np.errstate(invalid="ignore"):
            narrow = np.flatnonzero(inside & (reach >= least) & (reach < allowed))
        faults.extend(
            subject.fault(
                "cover-width", message, i, k, actual=float(reach[k]), allowed=float(allowed[k])
            )
            for k in narrow.tolist()
        )
    return faults
