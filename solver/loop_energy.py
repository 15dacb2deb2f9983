"""Energy of one loop in a space of smooth shapes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.disc_basis import DiscBasis, jet_map
from solver.fabric_bending import FabricBending
from solver.membrane import Membrane
from solver.quartic import LARGEST, FabricPolynomial, shape_table
from solver.reading import density_coefficients
from solver.rod import Rod
from solver.scene import LoopScene
from solver.twist import WireTwist, flat_wire_twist

Vectors = NDArray[np.float64]


@dataclass(frozen=True)
class LoopEnergy:
    """Fabric and wire of a scene, on shapes spanned by a basis.

    Attributes
    ----------
    membrane : Membrane
    rod : Rod
    basis : DiscBasis
    speed : array (Q,) or float
        Length of unstretched wire per angle at the basis' points of the edge.
    polynomial : FabricPolynomial or None
        The fabric's energy tabulated, where the basis is small and all directions are alike.
    twist : WireTwist or None
        Where the scene asks for it and the shapes of the basis can writhe.
    bending : FabricBending or None
        Where the scene asks for it.
    """

    membrane: Membrane
    rod: Rod
    basis: DiscBasis
    speed: Vectors | float = 1.0
    polynomial: FabricPolynomial | None = None
    twist: WireTwist | None = None
    bending: FabricBending | None = None

    def terms(self, q: Vectors) -> dict[str, float]:
        """Energy by term, units of E_f t R², at unknowns ``q`` (n,): docs/theory.md, eq. (1)."""
        basis = self.basis
        edge = basis.along_edge(q)
        bending, stretch = self.rod.energies(edge[:, :3], edge[:, 3:], basis.arc, self.speed)
        terms = {
            "fabric stretch": self.membrane.energy(basis.gradient @ q, basis.area),
            "wire bending": bending,
            "wire stretch": stretch,
        }
        if self.twist is not None:
            terms["wire twist"] = self.twist.energy(edge, basis.arc)
        if self.bending is not None:
            terms["fabric bending"] = self.bending.energy(jet_map(basis) @ q, basis.area)
        return terms

    def value(self, q: Vectors) -> float:
        """Energy at unknowns ``q`` (n,)."""
        return sum(self.terms(q).values())

    def derivatives(
        self, q: Vectors, force: Vectors | None = None
    ) -> tuple[float, Vectors, Vectors]:
        """Energy, gradient (n,) and Hessian (n, n) at unknowns ``q`` (n,).

        The Hessian takes the wire's tension to be ``force`` (Q,), where that is given.
        """
        basis = self.basis
        edge = basis.along_edge(q)
        wire = self.rod.derivatives(edge, basis.arc, basis.edge, self.speed, force)
        if self.polynomial is None:
            fabric = self.membrane.derivatives(basis.gradient @ q, basis.area, basis.gradient)
        else:
            fabric = self.polynomial.derivatives(q)
        value, slope, hessian = (fabric[k] + wire[k] for k in range(3))
        if self.twist is not None:
            own = self.twist.derivatives(edge, basis.arc, basis.edge)
            value, slope, hessian = value + own[0], slope + own[1], hessian + own[2]
        if self.bending is not None:
            jets = jet_map(basis)
            own = self.bending.derivatives(jets @ q, basis.area, jets)
            value, slope, hessian = value + own[0], slope + own[1], hessian + own[2]
        return float(value), slope, hessian

    def derivatives_around(
        self, gradient: Vectors, tangent: Vectors, second: Vectors
    ) -> tuple[float, Vectors, Vectors]:
        """Derivatives by the basis' unknowns around any shape, given at the basis' own points.

        Those of the fabric's stretch and of the wire's bending and stretch: the writhe of any shape
        is not that of the part of its edge that a symmetry repeats.

        Parameters
        ----------
        gradient : array (P, 3, 2)
            Derivatives of the position at the points of the disc.
        tangent, second : array (Q, 3)
            First and second derivative of the position at the points of the edge.
        """
        basis = self.basis
        fabric = self.membrane.derivatives(gradient, basis.area, basis.gradient)
        edge = np.concatenate([tangent, second], axis=1)
        wire = self.rod.derivatives(edge, basis.arc, basis.edge, self.speed)
        return float(fabric[0] + wire[0]), fabric[1] + wire[1], fabric[2] + wire[2]


def scene_membrane(scene: LoopScene) -> Membrane:
    """Fabric of a scene."""
    a, b = density_coefficients(scene.poisson, scene.reading)
    return Membrane(scene.strain, a, b, scene.semi_axes, scene.moduli)


def scene_rod(scene: LoopScene) -> Rod:
    """Wire of a scene."""
    return Rod(scene.beta, scene.axial_stiffness, scene.natural_curvature)


def scene_twist(scene: LoopScene, angle: Vectors) -> WireTwist | None:
    """Twist of a scene's wire at angles of the disc's edge; None where it is left out."""
    if scene.twist_ratio == 0:
        return None
    return flat_wire_twist(scene.beta, scene.twist_ratio, scene.semi_axes, angle)


def scene_bending(scene: LoopScene) -> FabricBending | None:
    """Bending of a scene's fabric; None where it is left out."""
    return FabricBending(scene.alpha) if scene.alpha > 0 else None


def edge_speed(scene: LoopScene, angle: Vectors) -> Vectors | float:
    """Length of unstretched wire per angle of the disc's edge."""
    along, across = scene.semi_axes
    return 1.0 if along == across else np.hypot(along * np.sin(angle), across * np.cos(angle))


def loop_energy(scene: LoopScene, basis: DiscBasis) -> LoopEnergy:
    """Energy of a scene on the shapes of a basis."""
    membrane = scene_membrane(scene)
    polynomial = None
    if scene.isotropic_circle and basis.size <= LARGEST:
        polynomial = FabricPolynomial(shape_table(basis), membrane.strain, membrane.a, membrane.b)
    speed = edge_speed(scene, basis.angle)
    twist = None if basis.mirrored else scene_twist(scene, basis.angle)
    bending = scene_bending(scene)
    return LoopEnergy(membrane, scene_rod(scene), basis, speed, polynomial, twist, bending)
