"""Which rung a scene requires.

A user asks for a tolerance; `solve_scene` takes the cheapest rung that meets it, looks back at what
the model left out, adds what turned out to matter where it can, and says the rest.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from solver.checks import OWN_CURVATURE, SLACK, TWIST
from solver.compact import solve_loop
from solver.errors import SceneError
from solver.ladder.answer import Answer, Rung
from solver.ladder.budget import MOST_WORK, Budget
from solver.ladder.contact import ContactChoice
from solver.ladder.fabric_share import curved_fabric
from solver.ladder.fidelity import Fidelity
from solver.ladder.law import ASKED, TILED, by_law, law_error
from solver.ladder.meshed import TWIST_ADDED, by_mesh
from solver.mesh.any_scene import MeshScene
from solver.mesh.scene import ArrayScene, Contact
from solver.mesh.sheet import SheetScene
from solver.scene import ROUND_WIRE_TWIST_RATIO, LoopScene
from solver.tolerance import check_tolerance

_Mesh = Callable[..., Answer]
"""`by_mesh` with what holds for the whole solve."""

TOLERANCE = 1e-4
"""Error of the height that is allowed where nobody says which."""
ARRAY_TOLERANCE = 0.1
"""The same of arrays whose loops act on each other: most meshes they can have err by more than a
hundredth."""

_MOST_EXCESS = 0.01
"""Of a wire's own curvature over its curvature, in parts of it, where the fabric is slack: smooth
shapes are too rough there to tell a smaller one."""
_PART_OF_TOLERANCE = 0.3
_HALF = 0.5
"""Of the work on meshes, for fabric without bending stiffness; the rest is for that with it."""
_WITH_BENDING = "the fabric's bending was added"
_CHEAPEST = "a smooth basis is the cheapest that meets the tolerance for one loop"


def prepare_tables() -> None:
    """Tabulate the smooth bases that most loops need, so that a solve's time is its own."""
    solve_loop(LoopScene(0.3, 0.0145, 0.3))


def usual_tolerance(scene: MeshScene) -> float:
    """Error of the height, relative to it, that is allowed of a scene unless another is asked."""
    alone = isinstance(scene, LoopScene) or (isinstance(scene, ArrayScene) and _tiles(scene))
    return TOLERANCE if alone else ARRAY_TOLERANCE


def solve_scene(
    scene: MeshScene,
    *,
    fidelity: Fidelity = Fidelity.AUTO,
    tolerance: float = 1e-3,
    allow_unreliable: bool = False,
    refinement: int | None = None,
    told: Callable[[str], None] = lambda _: None,
    contact: ContactChoice = ContactChoice.AUTO,
) -> Answer:
    """Solve a scene on the rung that is asked for, or on the cheapest that meets the tolerance.

    Parameters
    ----------
    tolerance : float
        Error of the height that is allowed, relative to it.
    allow_unreliable : bool
        Give the shape even where it must not be relied on.
    refinement, told
        Of scenes that a mesh solves: see `by_mesh`.
    contact : ContactChoice
        ``off``: a mesh that meets itself is given without contact, which is told with the number
        of its crossings. The smooth basis knows no contact, and goes on to the mesh.

    Raises
    ------
    SceneError
        When the rung cannot do the scene, the message names the one that can; or when the tolerance
        is not greater than 0 and finite.
    NotConvergedError
        When there is no shape to rely on.
    """
    check_tolerance(tolerance)
    mesh = partial(
        by_mesh, lenient=allow_unreliable, refinement=refinement, told=told, contact=contact
    )
    if isinstance(scene, SheetScene):
        return _solve_sheet(scene, fidelity, tolerance, mesh)
    if isinstance(scene, ArrayScene):
        return _solve_array(scene, fidelity, tolerance, mesh, lenient=allow_unreliable)
    return _solve_loop(scene, fidelity, tolerance, mesh, lenient=allow_unreliable)


def _solve_loop(
    scene: LoopScene, fidelity: Fidelity, tolerance: float, mesh: _Mesh, *, lenient: bool
) -> Answer:
    if fidelity is Fidelity.SCALING:
        return by_law(scene, ASKED)
    if fidelity is Fidelity.MESH:
        return mesh(scene, ASKED, tolerance)
    if fidelity is Fidelity.COMPACT:
        return _by_compact(scene, ASKED, tolerance, lenient=lenient)
    return _by_cheapest(scene, tolerance, mesh, lenient=lenient)


def _by_cheapest(scene: LoopScene, tolerance: float, mesh: _Mesh, *, lenient: bool) -> Answer:
    error = law_error(scene)
    if error <= tolerance:
        return by_law(scene, f"its error, at most {error:.2g}, is within the tolerance")
    if scene.alpha > 0:
        return _with_bending_if_it_matters(scene, tolerance, mesh, lenient=lenient)
    return _by_compact_or_mesh(scene, _CHEAPEST, tolerance, mesh, lenient=lenient)


def _with_bending_if_it_matters(
    scene: LoopScene, tolerance: float, mesh: _Mesh, *, lenient: bool
) -> Answer:
    """Leave the fabric's bending out where what it would change is well within the tolerance.

    Where fabric is slack without it, it may be taut with it, and a smooth basis tells that in a
    hundredth of a mesh's time.
    """
    limp = replace(scene, alpha=0.0)
    bare = _smooth(limp, _CHEAPEST, tolerance)
    if not _stands(bare):
        bent = _smooth(scene, f"{_CHEAPEST}; {_WITH_BENDING}", tolerance)
        if _stands(bent):
            return bent
        # bent as little as fabric that resists it, limp fabric would have this share or more
        if _reliable(bent, tolerance) and not _hardly_bends(bent, scene, tolerance):
            return _by_compact_or_mesh(scene, bent.reason, tolerance, mesh, lenient=lenient)
        half = Budget(_HALF * MOST_WORK)
        forgiving = partial(mesh, lenient=True, budget=half)
        bare = _by_compact_or_mesh(limp, _CHEAPEST, tolerance, forgiving, lenient=True)
        mesh = partial(mesh, budget=Budget((1 - _HALF) * MOST_WORK + half.work))
    curved = curved_fabric(bare, scene)
    if curved is None:  # no law knows such fabric
        return bare
    if _reliable(bare, tolerance) and _hardly_bends(bare, scene, tolerance):
        return replace(bare, omitted=(*bare.omitted, *curved.left_out(scene)))
    share = curved.bending_share(scene.alpha)
    reason = f"{_CHEAPEST}; {_WITH_BENDING}: {share:.2g} of what buckling releases"
    return _by_compact_or_mesh(scene, reason, tolerance, mesh, lenient=lenient)


def _reliable(answer: Answer, tolerance: float) -> bool:
    found = answer.equilibrium
    converged = found is not None and found.status == "converged"
    fatal = any(left.fatal for left in answer.omitted)
    return converged and not fatal and answer.height_error <= tolerance


def _hardly_bends(answer: Answer, scene: LoopScene, tolerance: float) -> bool:
    """Whether the fabric's bending, on a solved shape, is well within the tolerance."""
    curved = curved_fabric(answer, scene)
    share = 0.0 if curved is None else curved.bending_share(scene.alpha)
    return share <= _PART_OF_TOLERANCE * tolerance


def _by_compact_or_mesh(
    scene: LoopScene, reason: str, tolerance: float, mesh: _Mesh, *, lenient: bool
) -> Answer:
    """Solve in the smooth basis; where the fabric goes slack, on a mesh with a tension field."""
    smooth = _smooth(scene, reason, tolerance)
    if _stands(smooth):
        return smooth
    if smooth.reason != reason:  # the wire's twist was added
        scene, reason = replace(scene, twist_ratio=ROUND_WIRE_TWIST_RATIO), smooth.reason
    slack = _matters(smooth, SLACK)
    # a mesh knows no more of what would stop a wire that wriggles
    if _excess_of_own_curvature(smooth) > _MOST_EXCESS * scene.natural_curvature:
        return _by_compact(scene, reason, tolerance, lenient=lenient)
    why = "the fabric is slack" if slack else "the smooth basis did not settle"
    added = "a mesh" if scene.alpha > 0 else "a mesh with a tension field"
    reason = f"{why}: {added} was added"
    return mesh(scene, reason, tolerance, add_twist=True)


def _smooth(scene: LoopScene, reason: str, tolerance: float) -> Answer:
    """Solve in the smooth basis, with the wire's twist where the shape without it writhes."""
    smooth = _by_compact(scene, reason, tolerance, lenient=True)
    if not _lacks_twist(scene, smooth):
        return smooth
    scene = replace(scene, twist_ratio=ROUND_WIRE_TWIST_RATIO)
    return _by_compact(scene, f"{reason}; {TWIST_ADDED}", tolerance, lenient=True)


def _stands(smooth: Answer) -> bool:
    """Whether a smooth shape is an answer: settled, and of fabric that is taut."""
    found = smooth.equilibrium
    settled = found is not None and found.status == "converged"
    return settled and not _matters(smooth, SLACK)


def _lacks_twist(scene: LoopScene, answer: Answer) -> bool:
    """Whether a shape writhes and its wire's twist, which only straight wire has, was left out."""
    return _matters(answer, TWIST) and scene.natural_curvature == 0


def _excess_of_own_curvature(answer: Answer) -> float:
    told = (left.value for left in answer.omitted if left.term == OWN_CURVATURE)
    return next(told, 0.0)


def _matters(answer: Answer, term: str) -> bool:
    return any(left.term == term and left.matters for left in answer.omitted)


def _by_compact(scene: LoopScene, reason: str, tolerance: float, *, lenient: bool) -> Answer:
    found = solve_loop(scene, tolerance=tolerance, allow_unreliable=lenient)
    return Answer(
        rung=Rung.COMPACT,
        reason=reason,
        buckled=found.buckled,
        height_over_perimeter=found.shape.height_over_perimeter,
        height_error=found.height_change,
        terms=tuple(found.energy_terms),
        omitted=found.omitted,
        equilibrium=found,
    )


def _tiles(scene: ArrayScene) -> bool:
    """Whether one loop is all there is to solve: equal loops, gaps cut, wires side by side."""
    return (
        not scene.gaps_kept
        and scene.contact is Contact.BONDED
        and scene.equal_loop is not None
        and scene.loop.isotropic_circle
    )


def _solve_array(
    scene: ArrayScene, fidelity: Fidelity, tolerance: float, mesh: _Mesh, *, lenient: bool
) -> Answer:
    if scene.rows * scene.columns == 1:
        return _solve_loop(scene.loop, fidelity, tolerance, mesh, lenient=lenient)
    loop = scene.equal_loop
    if fidelity is not Fidelity.MESH and loop is not None and _tiles(scene):
        one = _solve_loop(loop, fidelity, tolerance, mesh, lenient=lenient)
        return replace(one, reason=f"{TILED}; {one.reason}")
    if fidelity in (Fidelity.SCALING, Fidelity.COMPACT):
        raise SceneError(f"these loops do not tile; {fidelity} solves one loop, mesh solves arrays")
    if fidelity is Fidelity.MESH:
        return mesh(scene, ASKED, tolerance)
    reason = "the loops of this array act on each other"
    return mesh(scene, reason, tolerance, add_twist=True)


def _solve_sheet(scene: SheetScene, fidelity: Fidelity, tolerance: float, solve: _Mesh) -> Answer:
    if fidelity in (Fidelity.SCALING, Fidelity.COMPACT):
        raise SceneError(f"{fidelity} solves one loop of its own; mesh solves any scene")
    if fidelity is Fidelity.MESH:
        return solve(scene, ASKED, tolerance)
    reason = "only a mesh knows scenes of many curves"
    return solve(scene, reason, tolerance, add_twist=True)
