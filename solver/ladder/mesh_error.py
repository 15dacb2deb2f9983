"""How far a height on a mesh is off, told from those on coarser meshes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import takewhile

import numpy as np
from numpy.typing import NDArray

from solver.mesh.any_scene import size_of
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.scene import ArrayScene
from solver.mesh.thickness import REACH
from solver.scene import LoopScene

Vectors = NDArray[np.float64]

FLAT = 1e-6
"""Height over the loops' mean radius up to which a shape is flat."""

_ORDER = 4.0
"""Each change is that much smaller than the one before when a second-order error is all."""
_LEAST_RATIO = 1.5
"""The changes that follow shrink at least so: none did by less, on scenes beside the exact ones."""
_CHANCE = 16.0
"""A change this much smaller than the one before is so by chance."""


def mesh_error(found: MeshEquilibrium, before: Sequence[MeshEquilibrium] = ()) -> float:
    """Error of the height, relative to it; infinite when there is no other mesh to tell it.

    Of a loop whose height two changes lead to, it is what is left of their geometric series; with
    one change alone, that series as if no change were less than 1.5 times smaller than the last.
    Of other scenes it is a third of the last change; of arrays with their fabric kept that of the
    loops' own heights, for the whole's settles later than all else: see
    `solver.mesh.omissions.mesh_omissions`.

    Parameters
    ----------
    before : sequence of MeshEquilibrium
        The same scene on coarser meshes, each with edges twice as long as the next.
    """
    if math.isnan(found.coarser_height):
        return math.inf
    alone = isinstance(found.scene, LoopScene)
    # solves of an array on two meshes may end in two of its many shapes
    now, *coarser = _sequence(found, before if alone else ())
    left = np.abs(now - coarser[0]) / (_ORDER - 1)
    if alone:
        earlier = coarser[0] - coarser[1] if len(coarser) > 1 else np.full_like(now, np.nan)
        left = _rest(now - coarser[0], earlier)
    error, height = float(left.max()), float(now.max())
    if found.contact is not None:  # parts keep no more apart than this beyond their thickness
        error = max(error, REACH * found.wire_diameter)
    flat = height <= FLAT * size_of(found.scene)
    return error / (size_of(found.scene) if flat else height)


def loops_alone(found: MeshEquilibrium) -> bool:
    """Whether only the loops' own heights are sharp: hinges leave the whole's open, or soft.

    Arrays whose fabric is cut lie level on all meshes.
    """
    if isinstance(found.scene, ArrayScene):
        return found.scene.gaps_kept
    return bool(found.free_motions)


def _sequence(found: MeshEquilibrium, before: Sequence[MeshEquilibrium]) -> list[Vectors]:
    """Heights on ever coarser meshes, of what minimises the same energy; the last is a rough one.

    They are those of the whole (1,); where it is open or soft, of each loop (w,).
    """
    alike = [found, *takewhile(lambda one: _alike(found, one), reversed(before))]
    if loops_alone(found):
        return [one.loop_heights for one in alike] + [alike[-1].coarser_loop_heights]
    whole = [one.height for one in alike] + [alike[-1].coarser_height]
    return [np.array([height]) for height in whole]


def _alike(found: MeshEquilibrium, before: MeshEquilibrium) -> bool:
    """Whether two shapes minimise the same energy, so that only their meshes differ."""
    contact = (found.contact is None) == (before.contact is None)
    field = found.tension_field == before.tension_field
    hinged = bool(found.free_motions) == bool(before.free_motions)
    return contact and field and hinged and found.scene == before.scene


def _rest(last: Vectors, earlier: Vectors) -> Vectors:
    """Sum of the changes that are still to come, from the last two; not a number where unknown."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.nan_to_num(earlier / last, nan=_LEAST_RATIO, posinf=_ORDER)
    series = np.abs(last) / (np.clip(ratio, _LEAST_RATIO, _ORDER) - 1)
    return np.fmax(series, np.abs(earlier) / _CHANCE)
