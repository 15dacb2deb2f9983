"""Where cover stitches cross laid wire."""

from __future__ import annotations

import numpy as np

from patterns.plan import BlockKind
from patterns.rules.subject import Subject
from patterns.stitching import ROUNDING_MM
from patterns.wire_index import Indices, Numbers


def satin_crossings(subject: Subject) -> tuple[Numbers, Indices]:
    """Find where satin stitches cross wire that was laid before them.

    Returns
    -------
    station_mm : array (n,)
        Arclengths along the whole wire.
    block : array (n,)
        The blocks of the stitches.
    """
    stations = [np.empty(0)]
    blocks = [np.empty(0, dtype=np.int64)]
    for i, block in enumerate(subject.plan.blocks):
        if block.kind is BlockKind.COVER and len(subject.needles_mm[i]):
            stations.append(_crossings(subject, i))
            blocks.append(np.full(len(stations[-1]), i))
    return np.concatenate(stations), np.concatenate(blocks)


def _crossings(subject: Subject, block: int) -> Numbers:
    """Arclengths at which the satin stitches of a block cross the wire nearest to them.

    A stitch that runs along the wire by more than two spacings is no satin and covers nothing.
    """
    needles = subject.needles_mm[block]
    laid = subject.laid_before(block)
    nearest = subject.wire.nearest(needles, subject.reach_mm, among=laid)
    station, side = nearest.station_mm, nearest.side_mm
    advance = np.diff(station)
    longest = 2 * subject.stitching.cover_spacing_mm + 2 * ROUNDING_MM
    sewn = np.ones(len(advance), dtype=np.bool_)
    ends = np.cumsum([len(run.needles) for run in subject.plan.blocks[block].runs])[:-1]
    sewn[ends[(ends > 0) & (ends < len(needles))] - 1] = False  # from run to run the machine jumps
    with np.errstate(invalid="ignore"):
        satin = sewn & (side[1:] * side[:-1] < 0) & (np.abs(advance) <= longest)
    share = np.abs(side[:-1][satin]) / np.abs(np.diff(side))[satin]
    return station[:-1][satin] + share * advance[satin]
