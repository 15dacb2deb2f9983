"""The account of a held loop: what was found, and what keeps it from being the answer."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from solver.branches import stability_floor
from solver.checks import CONTACT, looked_back, smallest_principal_stress
from solver.disc_basis import DiscBasis
from solver.edge_rows import edge_rows
from solver.held_equilibrium import HeldEquilibrium
from solver.held_refine import HeldSolved
from solver.held_stability import HeldStability, held_stability
from solver.loop_energy import scene_membrane
from solver.omitted import OmittedTerm
from solver.plates import Contact, PlateAxis, Plates
from solver.scene import LoopScene
from solver.shape import LoopShape
from solver.stiff_newton import tension_of
from solver.touching import plate_touches, reach

Vectors = NDArray[np.float64]

TILT = "friction or neighbours that keep the loop upright"
_QUARTER = np.linspace(0.0, np.pi / 2, 65)


def plates_share(plates: Plates) -> float:
    """Part of the Lagrangian's force of a contact that presses on one plate.

    Plates across x or y meet mirror images of one point, half of them each.
    """
    return 1.0 if plates.axis is PlateAxis.HEIGHT else 0.5


def room_across(basis: DiscBasis, q: Vectors) -> float:
    """Smallest distance of the wire from its mirror images; negative where it has crossed one."""
    x = edge_rows(basis, 0).of(q).at(_QUARTER)[0][:, 0]
    y = edge_rows(basis, 1).of(q).at(_QUARTER)[0][:, 0]
    middle = len(_QUARTER) // 2
    crossed = min(x[:-1].min(), y[1:].min())
    apart = min(x[: middle + 1].min(), y[middle:].min())
    return 2 * float(crossed if crossed < 0 else apart)


def _omitted(
    scene: LoopScene, solved: HeldSolved, stability: HeldStability, stress: float
) -> tuple[OmittedTerm, ...]:
    basis, q = solved.basis, solved.unknowns
    terms = looked_back(scene, basis, q, stress, solved.found.minimum.value)
    thick = solved.hold.wire_diameter if isinstance(solved.hold, Plates) else 0.0
    lacking = max(0.0, thick - room_across(basis, q))
    met = OmittedTerm(CONTACT, "overlap of opposite wires / R", lacking, lacking > 0, lacking > 0)
    tilts = stability.tilting < -stability_floor(scene)
    tilt = OmittedTerm(TILT, "lowest stiffness / E_f t", stability.tilting, matters=tilts)
    return (*(term for term in terms if term.term != CONTACT), met, tilt)


def _faults(
    scene: LoopScene,
    solved: HeldSolved,
    stability: HeldStability,
    omitted: tuple[OmittedTerm, ...],
    tolerance: float,
) -> list[str]:
    """Say what keeps the last basis' minimum from being the answer."""
    faults: list[str] = []
    if solved.change > tolerance:
        faults.append(
            f"not converged: force or height still change by {solved.change:.1e} from basis to "
            f"basis ({solved.basis.size} unknowns); a tolerance above that would pass"
        )
    if stability.upright < -stability_floor(scene):
        faults.append(
            f"the shape is not a minimum (lowest eigenvalue {stability.upright:.1e}): held like "
            "this the loop leaves its mirror planes; raise the gap or beta"
        )
    faults += [
        f"{left.term} is left out, and the shape is wrong without ({left.measure}: "
        f"{left.value:.2g}); raise the gap or beta"
        for left in omitted
        if left.fatal
    ]
    return faults


def _overlap(solved: HeldSolved) -> float:
    if not isinstance(solved.hold, Plates):
        return 0.0
    excess = plate_touches(solved.basis, solved.hold, solved.unknowns).excess
    return max(0.0, float(excess.max(initial=0.0)))


def _on_one_plate(solved: HeldSolved) -> tuple[Contact, ...]:
    if not isinstance(solved.hold, Plates):
        return ()
    share = plates_share(solved.hold)
    return tuple(replace(contact, force=share * contact.force) for contact in solved.contacts)


def held_equilibrium(scene: LoopScene, solved: HeldSolved, tolerance: float) -> HeldEquilibrium:
    """Look back at a solved loop, and give all that was found."""
    basis, q, minimum = solved.basis, solved.unknowns, solved.found.minimum
    stress = smallest_principal_stress(scene_membrane(scene), basis.gradient @ q)
    stability = held_stability(
        scene,
        solved.hold,
        basis,
        q,
        solved.contacts if isinstance(solved.hold, Plates) else (),
        stress=stress,
        compression=-float(tension_of(solved.energy, q).min()),
    )
    omitted = _omitted(scene, solved, stability, stress)
    across = float(solved.found.force[1:].sum()) / 2
    return HeldEquilibrium(
        scene=scene,
        hold=solved.hold,
        shape=LoopShape(basis.unknowns, q),
        status="; ".join(_faults(scene, solved, stability, omitted, tolerance)) or "converged",
        force=solved.force,
        force_across=0.0 if isinstance(solved.hold, Plates) else across,
        contacts=_on_one_plate(solved),
        energy_terms=solved.energy.terms(q),
        gradient_norm=minimum.gradient_norm,
        lowest_eigenvalue=stability.upright,
        tilt_eigenvalue=stability.tilting,
        overlap=_overlap(solved),
        widths=(2 * reach(basis, 0, q), 2 * reach(basis, 1, q)),
        height=solved.height,
        steps=minimum.steps,
        factorizations=minimum.factorizations,
        unknowns=basis.size,
        degree=basis.degree,
        change=solved.change,
        omitted=omitted,
    )
