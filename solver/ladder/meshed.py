"""The last rung: any scene, on a mesh that is refined until the tolerance is met."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from solver.checks import CONTACT
from solver.errors import NotConvergedError
from solver.ladder.answer import Answer, Rung
from solver.mesh.any_scene import MeshScene, fabric_of, size_of, twisted
from solver.mesh.barrier import REMEDY, contact_available
from solver.mesh.contact_solve import solve_in_contact
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.omissions import lacks_twist, mesh_omissions, wrinkles_escape
from solver.mesh.solve_any import solve_on_mesh
from solver.mesh.thickness import REACH
from solver.scene import ROUND_WIRE_TWIST_RATIO, LoopScene

FINEST_LOOP = 5
FINEST_ARRAY = 3
FINEST_SLACK_LOOP, FINEST_SLACK_ARRAY = 4, 3
"""Finer meshes of wrinkled fabric take hundreds of steps; what they would change is told."""
MOST_TRIANGLES = 25_000
"""Of the finest mesh, if coarser ones do not have more already."""
MOST_IN_CONTACT = 1700
"""Triangles of the finest mesh that is solved with contact, of which a step takes many times
longer: at the least two meshes are, to tell the error."""
LARGEST_IN_CONTACT = 6000
"""Triangles of a mesh on which contact is not even begun."""

TWIST_ADDED = "the wire's twist was added, for the shape without it has writhe"

_COARSEST_LOOP, _COARSEST_ARRAY = 2, 1
"""Refinements of the first mesh that is solved for itself."""
_FLAT = 1e-6
"""Height over the loops' mean radius up to which a shape is flat."""
_SHARES_OF_ERROR = 3.0
"""A second-order error is a third of its change from the mesh with edges twice as long."""


class _InContact:
    """Solves again, with contact, what meets itself; from then on every mesh."""

    def __init__(self, scene: MeshScene) -> None:
        self._scene = scene
        self._last: MeshEquilibrium | None = None

    def solved(self, found: MeshEquilibrium, refinement: int, *, lenient: bool) -> MeshEquilibrium:
        """Give the shape as it is, or solved with contact where that is needed and can be had."""
        needed = self._last is not None or found.meets_itself
        small = len(found.mesh.triangles) <= LARGEST_IN_CONTACT
        if not (needed and small and contact_available()):
            return found
        solved = solve_in_contact(
            self._scene,
            refinement=refinement,
            tension_field=found.tension_field,
            allow_unreliable=lenient,
            before=found.distances,
        )
        last = self._last
        self._last = replace(
            solved,
            coarser_height=math.nan if last is None else last.height,
            coarser_loop_heights=np.zeros(0) if last is None else last.loop_heights,
        )
        return self._last


def by_mesh(
    scene: MeshScene,
    reason: str,
    tolerance: float,
    *,
    lenient: bool,
    add_twist: bool = False,
    refinement: int | None = None,
    told: Callable[[str], None] = lambda _: None,
) -> Answer:
    """Refine until a third of the last change in height is the error allowed.

    Parameters
    ----------
    add_twist : bool
        Whether to add the twist of straight round wires where the shape without it writhes.
    refinement : int, optional
        Of the one mesh that is solved, whatever its error; the tolerance then plays no part.
    told : callable
        Told of every mesh before it is solved.
    """
    refinements = _refinements(scene, refinement)
    found = _refined(scene, tolerance, refinements, told, lenient=lenient, add_twist=add_twist)
    tolerance = math.inf if refinement is not None else tolerance
    if found.scene != scene:
        reason = f"{reason}; {TWIST_ADDED}"
    return _mesh_answer(found, reason, tolerance, lenient=lenient)


def _refinements(scene: MeshScene, only: int | None) -> range:
    """Refinements that may be solved, the coarsest first."""
    if only is not None:
        return range(only, only + 1)
    if isinstance(scene, LoopScene):
        return range(_COARSEST_LOOP, FINEST_LOOP + 1)
    return range(_COARSEST_ARRAY, FINEST_ARRAY + 1)


def _refined(
    scene: MeshScene,
    tolerance: float,
    refinements: range,
    told: Callable[[str], None],
    *,
    lenient: bool,
    add_twist: bool,
) -> MeshEquilibrium:
    """Solve on finer and finer meshes; from where plain fabric goes slack, with a tension field."""
    contact = _InContact(scene)
    refinement = refinements[0]
    field = False
    while True:
        told(f"mesh refined {refinement} times")
        found = _solved(scene, refinement, field=field, lenient=lenient)
        field = found.tension_field
        found = contact.solved(found, refinement, lenient=lenient)
        # where a shape passes through itself its writhe jumps and tells nothing
        if add_twist and not found.meets_itself and lacks_twist(found):
            with_twist = twisted(scene, ROUND_WIRE_TWIST_RATIO)
            try:
                return _refined(
                    with_twist, tolerance, refinements, told, lenient=lenient, add_twist=False
                )
            except NotConvergedError:
                add_twist = False  # the account of what is left out tells the twist
        _check_converged(found, lenient=lenient)
        # two coarse meshes may agree by chance
        settled = refinement > _COARSEST_ARRAY and _mesh_error(found) <= tolerance
        if settled or refinement >= refinements[-1] or _finest(scene, found, refinement):
            return found
        refinement += 1


def _solved(scene: MeshScene, refinement: int, *, field: bool, lenient: bool) -> MeshEquilibrium:
    loop = fabric_of(scene)
    knows_field = loop.modulus_ratio == 1
    if not field:
        # a plain solve that fails may be one that wrinkles: the tension field has its turn
        found = solve_on_mesh(
            scene, refinement, tension_field=False, allow_unreliable=lenient or knows_field
        )
        slack = loop.strain > 0 and wrinkles_escape(found)
        if not (knows_field and (slack or found.status != "converged")):
            return found
    # and so may one be that meets itself: contact has its turn
    return solve_on_mesh(scene, refinement, tension_field=True, allow_unreliable=True)


def _finest(scene: MeshScene, found: MeshEquilibrium, refinement: int) -> bool:
    """Whether no finer mesh is to be solved."""
    finest = FINEST_SLACK_LOOP if isinstance(scene, LoopScene) else FINEST_SLACK_ARRAY
    slackened = found.tension_field and refinement >= finest
    large = 4 * len(found.mesh.triangles) > MOST_TRIANGLES
    beyond_help = found.contact is None and found.meets_itself
    return slackened or large or beyond_help or _finest_in_contact(found)


def _check_converged(found: MeshEquilibrium, *, lenient: bool) -> None:
    # what meets itself is refused for that, with what would mend it
    if not (lenient or found.status == "converged" or found.meets_itself):
        raise NotConvergedError(found.status)


def _finest_in_contact(found: MeshEquilibrium) -> bool:
    """Whether two meshes were solved with contact, and the next one would be too fine for it."""
    told = found.contact is not None and not math.isnan(found.coarser_height)
    return told and 4 * len(found.mesh.triangles) > MOST_IN_CONTACT


def _mesh_error(found: MeshEquilibrium) -> float:
    """Error of the height, relative to it; infinite when there is no other mesh to tell it."""
    if math.isnan(found.coarser_height):
        return math.inf
    change, height = abs(found.height - found.coarser_height), found.height
    if found.free_motions:  # hinges leave the whole's height open, but not that of each loop
        change = float(np.abs(found.loop_heights - found.coarser_loop_heights).max())
        height = float(found.loop_heights.max())
    change /= _SHARES_OF_ERROR
    if found.contact is not None:  # parts keep no more apart than this beyond their thickness
        change = max(change, REACH * found.wire_diameter)
    flat = height <= _FLAT * size_of(found.scene)
    return change / (size_of(found.scene) if flat else height)


def _buckled(found: MeshEquilibrium) -> bool:
    return found.height > _FLAT * size_of(found.scene)


def _contact_remedy() -> str:
    if not contact_available():
        return f"to add contact: {REMEDY}"
    return f"contact is solved on up to {LARGEST_IN_CONTACT} triangles: solve fewer loops"


def _error_remedy(found: MeshEquilibrium, error: float) -> str:
    triangles = len(found.mesh.triangles)
    remedy = "allow a larger tolerance"
    if 4 * triangles > MOST_TRIANGLES and not isinstance(found.scene, LoopScene):
        remedy += " or solve fewer loops"
    return (
        f"the finest mesh, of {triangles} triangles, still errs by {error:.1e} in the height; "
        f"{remedy}"
    )


def _mesh_answer(found: MeshEquilibrium, reason: str, tolerance: float, *, lenient: bool) -> Answer:
    omitted = mesh_omissions(found)
    error = _mesh_error(found)
    faults = [f"{o.term} is left out, and the shape is wrong without" for o in omitted if o.fatal]
    if any(o.fatal and o.term == CONTACT for o in omitted):
        faults.append(_contact_remedy())
    if found.contact is not None and found.distances.crossings:
        faults.append("the shape still passes through itself; raise beta or lower strain")
    if error > tolerance:
        faults.append(_error_remedy(found, error))
    if faults and not lenient:
        raise NotConvergedError("; ".join(faults))
    if found.contact is not None:
        reason += "; the shape met itself: contact was added"
    return Answer(
        rung=Rung.MESH,
        reason=reason,
        buckled=_buckled(found),
        height_over_perimeter=found.height_over_perimeter,
        height_error=error,
        terms=tuple(found.energy_terms),
        omitted=omitted,
        equilibrium=found,
    )
