"""A solved scene in the unit of length in which it was asked."""

from __future__ import annotations

from dataclasses import replace

from solver.mesh.equilibrium import ContactAccount, MeshEquilibrium
from solver.mesh.sheet import SheetScene
from solver.mesh.triangulation import Mesh


def in_unit_of(scene: SheetScene, found: MeshEquilibrium) -> MeshEquilibrium:
    """Give lengths, energies and forces in the scene's unit; stiffnesses are the same in all."""
    size = scene.size
    return replace(
        found,
        scene=scene,
        mesh=_mesh_in_unit_of(scene, found.mesh),
        positions=size * found.positions,
        energy_terms={name: size**2 * energy for name, energy in found.energy_terms.items()},
        gradient_norm=size * found.gradient_norm,
        height=size * found.height,
        loop_heights=size * found.loop_heights,
        coarser_height=size * found.coarser_height,
        coarser_loop_heights=size * found.coarser_loop_heights,
        perimeter=size * found.perimeter,
        contact=None if found.contact is None else _contact_in_unit(size, found.contact),
    )


def _mesh_in_unit_of(scene: SheetScene, meshed: Mesh) -> Mesh:
    size = scene.size
    curves = [wire.curve for wire in scene.wires] + list(scene.outlines)
    chains = [
        replace(chain, track=replace(chain.track, curve=curve)) if chain.track else chain
        for chain, curve in zip(meshed.chains, curves, strict=True)
    ]
    rounds = tuple(
        replace(
            region,
            centre=(size * region.centre[0], size * region.centre[1]),
            semi_axes=(size * region.semi_axes[0], size * region.semi_axes[1]),
        )
        for region in meshed.rounds
    )
    count = len(scene.wires)
    return replace(
        meshed,
        points=size * meshed.points,
        rounds=rounds,
        wires=tuple(chains[:count]),
        borders=tuple(chains[count:]),
    )


def _contact_in_unit(size: float, contact: ContactAccount) -> ContactAccount:
    # what the shape was before contact was measured in the scene's unit
    return replace(
        contact,
        wire_diameter=size * contact.wire_diameter,
        largest_force=size * contact.largest_force,
    )
