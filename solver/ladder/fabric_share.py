"""Whether the fabric's bending is worth its while: its energy on the shape without it."""

from __future__ import annotations

from dataclasses import dataclass

from solver.branches import flat_state
from solver.checks import gauss_left_out
from solver.circle import flat_circle
from solver.disc_basis import Space, disc_basis, jet_map
from solver.equilibrium import Equilibrium, Kind
from solver.fabric_bending import FabricBending, gauss_integral
from solver.ladder.answer import Answer
from solver.mesh.equilibrium import MeshEquilibrium
from solver.mesh.star_bending import star_bending, star_gauss_integral
from solver.omitted import OmittedTerm
from solver.scene import LoopScene
from solver.symmetry import ALIGNED, DIAGONAL

FABRIC_BENDING = "bending of the fabric"
_MEASURE = "its energy / energy released by buckling"
_LEAST = 1e-12
"""Rounding of energies."""

_SPACES: dict[Kind, Space] = {
    Kind.SADDLE: "saddle",
    Kind.ALIGNED: ALIGNED,
    Kind.DIAGONAL: DIAGONAL,
    Kind.OBLIQUE: "oblique",
}


@dataclass(frozen=True)
class CurvedFabric:
    """∫ H² dA and ∫ K dA of a solved shape, its energy, and what it released by buckling."""

    squared_mean: float
    gaussian: float
    energy: float
    released: float

    def bending_share(self, alpha: float) -> float:
        """α ∫ H² dA over the energy that buckling releases.

        About by so much the height of the shape without it is wrong: near the threshold both
        energies are small, the one as the sixth and the other as the fourth power of the height,
        and the height errs by 3/4 of this share.
        """
        return 0.0 if self.squared_mean == 0 else alpha * self.squared_mean / self.released

    def left_out(self, scene: LoopScene) -> tuple[OmittedTerm, ...]:
        """Account of the fabric's bending where it has a small share of the energy."""
        share = self.bending_share(scene.alpha)
        return (
            OmittedTerm(FABRIC_BENDING, _MEASURE, share, matters=False),
            *gauss_left_out(scene.alpha, scene.poisson, self.gaussian, self.energy),
        )


def curved_fabric(answer: Answer, scene: LoopScene) -> CurvedFabric | None:
    """Measure a solved loop; None where only a law was asked."""
    found = answer.equilibrium
    if found is None:
        return None
    if not answer.buckled:
        return CurvedFabric(0.0, 0.0, found.energy, 0.0)
    integrals = _of_loop(found) if isinstance(found, Equilibrium) else _of_mesh(found)
    flat = flat_circle(scene) if scene.isotropic_circle else flat_state(scene)[0]
    released = max(flat.minimum.value - found.energy, _LEAST * found.energy)
    return CurvedFabric(*integrals, found.energy, released)


def _of_loop(found: Equilibrium) -> tuple[float, float]:
    basis = disc_basis(found.degree, _SPACES[found.kind])
    jet = jet_map(basis) @ found.shape.coefficients
    return FabricBending(1.0).energy(jet, basis.area), gauss_integral(jet, basis.area)


def _of_mesh(found: MeshEquilibrium) -> tuple[float, float]:
    stars = star_bending(found.mesh, 1.0)
    squared = sum(float(e.energies(found.positions[e.vertices]).sum()) for e in stars)
    return squared, star_gauss_integral(found.mesh, found.positions)
