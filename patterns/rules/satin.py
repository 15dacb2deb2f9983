"""Where cover stitches cross laid wire."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from patterns.plan import BlockKind
from patterns.rules.subject import Subject
from patterns.stitching import ROUNDING_MM
from patterns.wire_index import Indices, Nearest, Numbers


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


def satin_stitches(subject: Subject, block: int) -> tuple[Nearest, NDArray[np.bool_]]:
    """Tell which stitches of a cover are satin over the laid wire nearest to them.

    A stitch that runs along the wire by more than two spacings is no satin and covers nothing.

    Returns
    -------
    nearest : Nearest
        Of each needle point (n,) of the block, its place on the wire.
    satin : array of bool (n - 1,)
        Of each stitch from one needle point to the next.
    """
    needles = subject.needles_mm[block]
    laid = subject.laid_before(block)
    nearest = subject.wire.nearest(needles, subject.reach_mm, among=laid)
    longest = 2 * subject.stitching.cover_spacing_mm + 2 * ROUNDING_MM
    sewn = np.ones(len(needles) - 1, dtype=np.bool_)
    ends = np.cumsum([len(run.needles) for run in subject.plan.blocks[block].runs])[:-1]
    sewn[ends[(ends > 0) & (ends < len(needles))] - 1] = False  # from run to run the machine jumps
    side, station = nearest.side_mm, nearest.station_mm
    with np.errstate(invalid="ignore"):
        near = np.abs(np.diff(station)) <= longest
        return nearest, sewn & (side[1:] * side[:-1] < 0) & near


def _crossings(subject: Subject, block: int) -> Numbers:
    """Arclengths at which the satin stitches of a block cross the wire."""
    nearest, satin = satin_stitches(subject, block)
    station, side = nearest.station_mm, nearest.side_mm
    share = np.abs(side[:-1][satin]) / np.abs(np.diff(side))[satin]
    return station[:-1][satin] + share * np.diff(station)[satin]
