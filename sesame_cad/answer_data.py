"""The numbers of a dimensionless solve as plain data, on whichever rung it was done."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from sesame_cad.omitted_data import omitted_data
from solver.round_wire import wire_diameter

if TYPE_CHECKING:  # the scaling rung must not load what the others need
    from solver.equilibrium import Equilibrium
    from solver.ladder.answer import Answer
    from solver.mesh.equilibrium import MeshEquilibrium
    from solver.mesh.self_contact import SelfContact

Data = dict[str, Any]


def answer_data(answer: Answer, seconds: float) -> Data:
    """Keys of `sesame-cad solve`; null where a rung cannot tell or a length in SI units is needed.

    The same for every rung: those of a solved loop, then which rung and why, what is in the energy,
    and the estimated error of the height. ``distances`` are those of the answer, with or without
    contact, in units of R: null where the smallest is further than was looked. Crossings are
    counted on meshes. ``writhe``, in turns, is that of the wire that writhes most.
    """
    found = answer.equilibrium
    if found is None:
        details = _law_data(answer)
    elif hasattr(found, "shape"):
        details = _loop_data(found)  # pyright: ignore[reportArgumentType]
    else:
        details = _mesh_data(found)  # pyright: ignore[reportArgumentType]
    return {
        "buckled": answer.buckled,
        "height_mm": None,
        "height_over_perimeter": answer.height_over_perimeter,
        "pitch_mm": None,
        "energy_mJ": None,
        "contact": None,
        "negative_eigenvalues": None,
        "way_down": None,
        "distances": None,
        **details,
        "seconds": round(seconds, 6),
        "omitted_terms": omitted_data(answer.omitted),
        "rung": str(answer.rung),
        "reason": answer.reason,
        "terms": list(answer.terms),
        "height_error": answer.height_error if math.isfinite(answer.height_error) else None,
    }


def _law_data(answer: Answer) -> Data:
    return {
        "height_over_radius": 2 * math.pi * answer.height_over_perimeter,
        "pitch_over_diameter": None,
        "energy": None,
        "energy_terms": None,
        "status": "converged" if math.isfinite(answer.height_error) else "not compared",
        "gradient_norm": None,
        "lowest_eigenvalue": None,
        "writhe": None,
        "steps": 0,
        "factorizations": 0,
        "unknowns": 0,
        "height_change": None,
    }


def _loop_data(found: Equilibrium) -> Data:
    return {
        "height_over_radius": found.shape.height,
        "pitch_over_diameter": found.shape.width / 2,
        "height_change": found.height_change,
        "kind": str(found.kind),
        "distances": {
            "wire_diameter_over_radius": wire_diameter(found.scene),
            "looked_over_radius": None,
            "wire_to_wire": found.wire_gap,
            "wire_to_fabric": found.fabric_gap,
            "crossings": None,
        },
        **solve_account(found),
    }


def _mesh_data(found: MeshEquilibrium) -> Data:
    return {
        "height_over_radius": found.height,
        "pitch_over_diameter": None,
        "height_change": abs(found.height - found.coarser_height),
        "loop_heights_over_radius": [float(height) for height in found.loop_heights],
        "triangles": len(found.mesh.triangles),
        "compressed_fraction": found.compressed_fraction,
        "negative_eigenvalues": found.negative_eigenvalues,
        "way_down": found.way_down,
        "contact": _contact_data(found),
        "distances": {
            "wire_diameter_over_radius": found.wire_diameter,
            "looked_over_radius": found.looked,
            **_near(found.distances),
        },
        **solve_account(found),
    }


def _contact_data(found: MeshEquilibrium) -> Data | None:
    """What contact did to a shape; null where it was not needed. Lengths in units of R."""
    contact = found.contact
    if contact is None:
        return None
    return {
        "wire_diameter_over_radius": contact.wire_diameter,
        "before": _distances(contact.before),
        "after": _distances(found.distances),
        "touching_pairs": contact.touching,
        "largest_force": contact.largest_force,
        "energy_share": contact.energy_share,
    }


def _distances(near: SelfContact | None) -> Data | None:
    return None if near is None else _near(near)


def _near(near: SelfContact) -> Data:
    """Null for a distance that is larger than was looked."""
    wires, fabric = near.wire_to_wire, near.wire_to_fabric
    return {
        "wire_to_wire": wires if math.isfinite(wires) else None,
        "wire_to_fabric": fabric if math.isfinite(fabric) else None,
        "crossings": near.crossings,
    }


def solve_account(found: Equilibrium | MeshEquilibrium) -> Data:
    """Keys that tell how a shape was found, and with what energy."""
    return {
        "energy": found.energy,
        "energy_terms": found.energy_terms,
        "status": found.status,
        "gradient_norm": found.gradient_norm,
        "lowest_eigenvalue": found.lowest_eigenvalue,
        "writhe": found.writhe,
        "steps": found.steps,
        "factorizations": found.factorizations,
        "unknowns": found.unknowns,
    }
