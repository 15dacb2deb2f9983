"""The last rung: any scene, on a mesh that is refined until the tolerance is met."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

from solver.checks import CONTACT, OWN_CURVATURE
from solver.errors import NotConvergedError
from solver.ladder.answer import Answer, Rung
from solver.ladder.budget import MOST_WORK, Budget
from solver.ladder.contact import (
    ContactChoice,
    InContact,
    contact_remedy,
    finest_in_contact,
    refuse_what_meets_itself,
)
from solver.ladder.edges import MOST_TRIANGLES, edges_of_a_loop, loop_vertices
from solver.ladder.mesh_error import FLAT, loops_alone, mesh_error
from solver.ladder.refusal import refused
from solver.mesh.any_scene import MeshScene, fabric_of, size_of, twisted
from solver.mesh.drawing import SEGMENTS
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.omissions import lacks_twist, mesh_omissions, wriggles, wrinkles_escape
from solver.mesh.scene import ArrayScene
from solver.mesh.solve_any import solve_on_mesh
from solver.scene import ROUND_WIRE_TWIST_RATIO, LoopScene

FINEST_LOOP = 5
FINEST_ARRAY = 3
FINEST_SLACK_LOOP, FINEST_SLACK_ARRAY = 4, 3
"""Finer meshes of wrinkled fabric take hundreds of steps; what they would change is told."""
TWIST_ADDED = "the wire's twist was added, for the shape without it has writhe"

_COARSEST_LOOP, _COARSEST_ARRAY = 2, 1
"""Refinements of the first mesh that is solved for itself."""
_MANY_LOOPS = 9
_MOST_STEPS = 500
"""On one mesh of a loop, where the budget allows as many."""


def by_mesh(
    scene: MeshScene,
    reason: str,
    tolerance: float,
    *,
    lenient: bool,
    add_twist: bool = False,
    refinement: int | None = None,
    told: Callable[[str], None] = lambda _: None,
    contact: ContactChoice = ContactChoice.AUTO,
    budget: Budget | None = None,
) -> Answer:
    """Refine until what the height may still change by is the error allowed.

    Parameters
    ----------
    add_twist : bool
        Whether to add the twist of straight round wires where the shape without it writhes.
    refinement : int, optional
        Of the one mesh that is solved, whatever its error; the tolerance then plays no part.
    told : callable
        Told of every mesh before it is solved.
    contact : ContactChoice
        ``off`` gives a shape that meets itself as it is, and tells it.
    budget : Budget, optional
        Work that may be spent; by default all that one answer may take.
    """
    refinements = _refinements(scene, refinement)
    if contact is ContactChoice.AUTO and not lenient:
        alone = partial(_solved, segments=SEGMENTS, field=False)
        refuse_what_meets_itself(scene, refinements[0], alone)
    budget = budget or Budget(MOST_WORK)
    found, error = _refined(
        scene,
        tolerance,
        refinements,
        told,
        contact,
        budget=budget,
        lenient=lenient,
        add_twist=add_twist,
    )
    tolerance = math.inf if refinement is not None else tolerance
    if found.scene != scene:
        reason = f"{reason}; {TWIST_ADDED}"
    return _mesh_answer((found, error), reason, tolerance, contact, budget, lenient=lenient)


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
    choice: ContactChoice,
    *,
    budget: Budget,
    lenient: bool,
    add_twist: bool,
) -> tuple[MeshEquilibrium, float]:
    """Solve on finer and finer meshes; from where plain fabric goes slack, with a tension field.

    Gives the last one's shape, and the error of its height.
    """
    contact = InContact(scene, choice, budget)
    refinement = refinements[0]
    before: list[MeshEquilibrium] = []
    field = _slack_for_sure(scene)
    # one mesh asked for by its refinement is that of loops as they are elsewhere
    segments = edges_of_a_loop(scene) if len(refinements) > 1 else SEGMENTS
    while True:
        told(f"mesh refined {refinement} times")
        try:
            found = _solved(scene, refinement, budget, segments=segments, field=field)
        except NotConvergedError as fault:
            raise refused(str(fault), before) from None
        field = found.tension_field
        try:
            found = contact.solved(found, refinement, lenient=lenient)
        except NotConvergedError as fault:
            raise refused(str(fault), before, scene) from None
        # where a shape passes through itself its writhe jumps and tells nothing
        if add_twist and not found.meets_itself and lacks_twist(found):
            with_twist = twisted(scene, ROUND_WIRE_TWIST_RATIO)
            try:
                return _refined(
                    with_twist,
                    tolerance,
                    refinements,
                    told,
                    choice,
                    budget=budget,
                    lenient=lenient,
                    add_twist=False,
                )
            except NotConvergedError:
                add_twist = False  # the account of what is left out tells the twist
        _check_converged(found, before, choice, budget, lenient=lenient)
        error = mesh_error(found, before)
        # two coarse meshes may agree by chance
        settled = (refinement > refinements[0] and error <= tolerance) or wriggles(found)
        last = refinement >= refinements[-1] or _finest(scene, found, refinement, choice)
        if settled or last or not _affords_finer(budget, found):
            return found, error
        before.append(found)
        refinement += 1


def _slack_for_sure(scene: MeshScene) -> bool:
    """Whether the fabric of an array need not be solved plain first: large ones all go slack.

    Where fabric stays taut the tension field is the plain energy.
    """
    if not isinstance(scene, ArrayScene) or scene.rows * scene.columns < _MANY_LOOPS:
        return False
    fabric = scene.loop
    return fabric.alpha == 0 and fabric.strain > 0 and scene.gaps_kept


def _affords_finer(budget: Budget, found: MeshEquilibrium) -> bool:
    """Whether a mesh of four times the triangles can be begun: a loop's, or any with contact."""
    contact = found.contact is not None
    limited = contact or isinstance(found.scene, LoopScene)
    finer = 4 * len(found.mesh.points)
    return not limited or budget.allows(finer, fabric_of(found.scene).alpha, contact=contact)


def _solved_within(
    budget: Budget | None, scene: MeshScene, refinement: int, *, segments: int, field: bool
) -> MeshEquilibrium:
    """Solve one mesh, that of a loop within the budget."""
    solve = partial(
        solve_on_mesh,
        scene,
        refinement,
        segments=segments,
        tension_field=field,
        allow_unreliable=True,
    )
    if budget is None or not isinstance(scene, LoopScene):
        return solve()
    vertices = loop_vertices(segments, refinement)
    found = solve(most_steps=budget.steps(_MOST_STEPS, vertices, scene.alpha))
    budget.spend(found.work, scene.alpha)
    return found


def _solved(
    scene: MeshScene, refinement: int, budget: Budget | None = None, *, segments: int, field: bool
) -> MeshEquilibrium:
    solve = partial(_solved_within, budget, scene, refinement, segments=segments)
    loop = fabric_of(scene)
    if not field:
        # a plain solve that fails may be one that wrinkles: the tension field has its turn
        found = solve(field=False)
        slack = loop.strain > 0 and wrinkles_escape(found)
        if not slack and found.status == "converged":
            return found
    # and so may one be that meets itself: contact has its turn
    return solve(field=True)


def _finest(
    scene: MeshScene, found: MeshEquilibrium, refinement: int, choice: ContactChoice
) -> bool:
    """Whether no finer mesh is to be solved."""
    finest = FINEST_SLACK_LOOP if isinstance(scene, LoopScene) else FINEST_SLACK_ARRAY
    slackened = found.tension_field and refinement >= finest
    large = 4 * len(found.mesh.triangles) > MOST_TRIANGLES
    wanted = choice is ContactChoice.AUTO and found.meets_itself
    beyond_help = wanted and found.contact is None
    return slackened or large or beyond_help or finest_in_contact(found)


def _check_converged(
    found: MeshEquilibrium,
    before: list[MeshEquilibrium],
    choice: ContactChoice,
    budget: Budget,
    *,
    lenient: bool,
) -> None:
    # what meets itself is refused for that, with what would mend it
    told = choice is ContactChoice.AUTO and found.meets_itself
    if not (lenient or found.status == "converged" or told):
        spent = f"; one answer may take {MOST_WORK} steps times vertices"
        raise refused(found.status + (spent if budget.ran_short else ""), before)


def _buckled(found: MeshEquilibrium) -> bool:
    return found.height > FLAT * size_of(found.scene)


def _how_it_meets(found: MeshEquilibrium) -> str:
    near = found.distances
    if near.crossings:
        return (
            f"the shape passes through itself, at {near.crossings} pairs of an edge and a triangle"
        )
    apart = min(near.wire_to_wire, 2 * near.wire_to_fabric) / found.wire_diameter
    return f"parts come as near as {apart:.2g} of what the wire's thickness allows"


def _way_down(found: MeshEquilibrium) -> str:
    """Say of a minimum that has negative eigenvalues how little they matter."""
    if found.status != "converged" or not found.negative_eigenvalues:
        return ""
    return (
        f"; {found.negative_eigenvalues} negative eigenvalues were left, for the way down gains "
        f"{found.way_down:.1e} of the energy"
    )


def _error_remedy(found: MeshEquilibrium, error: float, budget: Budget) -> str:
    triangles = len(found.mesh.triangles)
    remedy = "allow a larger tolerance"
    if 4 * triangles > MOST_TRIANGLES and not isinstance(found.scene, LoopScene):
        remedy += " or solve fewer loops"
    elif budget.ran_short:
        remedy += f"; a finer one would take more than {MOST_WORK} steps times vertices"
    return (
        f"the finest mesh, of {triangles} triangles, still errs by {error:.1e} in the height; "
        f"{remedy}"
    )


def _mesh_answer(
    finest: tuple[MeshEquilibrium, float],
    reason: str,
    tolerance: float,
    contact: ContactChoice,
    budget: Budget,
    *,
    lenient: bool,
) -> Answer:
    found, error = finest
    omitted = mesh_omissions(found)
    off = contact is ContactChoice.OFF
    fatal = [o.term for o in omitted if o.fatal and not (off and o.term == CONTACT)]
    faults = [f"{term} is left out, and the shape is wrong without" for term in fatal]
    if OWN_CURVATURE in fatal:
        faults.append("the wire would wriggle; lower natural_curvature")
    if CONTACT in fatal:
        faults.append(contact_remedy(found.scene))
    if found.contact is not None and found.distances.crossings:
        faults.append("the shape still passes through itself; raise beta or lower strain")
    if error > tolerance:
        faults.append(_error_remedy(found, error, budget))
    if faults and not lenient:
        raise NotConvergedError("; ".join(faults))
    if found.contact is not None:
        reason += "; the shape met itself: contact was added"
    elif off and found.meets_itself:
        reason += f"; contact was left out, as asked: {_how_it_meets(found)}"
    if isinstance(found.scene, ArrayScene) and loops_alone(found):
        reason += "; the error is that of the loops' own heights"
    return Answer(
        rung=Rung.MESH,
        reason=reason + _way_down(found),
        buckled=_buckled(found),
        height_over_perimeter=found.height_over_perimeter,
        height_error=error,
        terms=tuple(found.energy_terms),
        omitted=omitted,
        equilibrium=found,
    )
