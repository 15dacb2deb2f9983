"""How height and width of a solved loop change with what it is made of.

At an equilibrium q the gradient g(q, p) vanishes for every value of a parameter p, so that by the
implicit function theorem dq/dp = −H⁻¹ ∂g/∂p, with H the Hessian that the solve has made anyway.
Height and width are linear in q. No further solve is needed.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from solver.disc_basis import DiscBasis, disc_basis
from solver.equilibrium import Equilibrium
from solver.errors import SceneError
from solver.loop_energy import loop_energy, scene_membrane
from solver.reading import density_slopes
from solver.rod import Rod
from solver.saddle_rows import crest_distance, crest_less_valley
from solver.scene import LoopScene

Vectors = NDArray[np.float64]

PARAMETERS = ("strain", "beta", "poisson", "axial_stiffness")


@dataclass(frozen=True, slots=True)
class Sensitivities:
    """Derivatives by each of `PARAMETERS`.

    Attributes
    ----------
    height : mapping of str to float
        Of the height in units of R; 0 for a flat loop.
    width : mapping of str to float
        Of the distance of opposite crests in units of R.
    """

    height: Mapping[str, float]
    width: Mapping[str, float]


def gradient_slopes(scene: LoopScene, basis: DiscBasis, q: Vectors) -> dict[str, Vectors]:
    """Derivatives ∂g/∂p (n,) of the energy's gradient by each of `PARAMETERS`, exactly.

    The energy is linear in β, in the axial stiffness and in the coefficients a and b of the
    fabric's density. Its gradient is s² g₄ − g₂ with s = 1 + ε, and g₄ is what two prestrains tell.
    """
    edge = basis.along_edge(q)
    membrane = scene_membrane(scene)

    def of_wire(beta: float, axial_stiffness: float) -> Vectors:
        return Rod(beta, axial_stiffness).derivatives(edge, basis.arc, basis.edge)[1]

    def of_fabric(strain: float, a: float, b: float) -> Vectors:
        fabric = replace(membrane, strain=strain, a=a, b=b)
        return fabric.derivatives(basis.gradient @ q, basis.area, basis.gradient)[1]

    s, other = 1 + scene.strain, 2 + scene.strain
    here, there = (of_fabric(one - 1, membrane.a, membrane.b) for one in (s, other))
    quartic = (there - here) / (other**2 - s**2)
    return {
        "strain": 2 * s * quartic,
        "beta": of_wire(1.0, 0.0),
        "poisson": of_fabric(scene.strain, *density_slopes(scene.poisson, scene.reading)),
        "axial_stiffness": of_wire(0.0, 1.0),
    }


def sensitivities(found: Equilibrium) -> Sensitivities:
    """Differentiate the height and width of a circular loop on isotropic fabric.

    Raises
    ------
    SceneError
        When the loop is another, or its fabric's bending or wire's own curvature is in the energy.
    """
    scene = found.scene
    if not scene.isotropic_circle or scene.natural_curvature > 0 or scene.alpha > 0:
        raise SceneError(
            "sensitivities are those of a circle of straight wire on isotropic fabric without "
            "bending: axis_ratio and modulus_ratio 1, natural_curvature and alpha 0"
        )
    basis = disc_basis(found.degree, "saddle")
    q = found.shape.coefficients
    hessian = loop_energy(scene, basis).derivatives(q)[2]
    slopes = gradient_slopes(scene, basis, q)
    moved = np.linalg.solve(hessian, -np.stack([slopes[key] for key in PARAMETERS], axis=1))
    rise = crest_less_valley(basis) @ moved
    if not found.buckled:
        rise = np.zeros(len(PARAMETERS))
    wide = 2 * crest_distance(basis) @ moved
    return Sensitivities(
        dict(zip(PARAMETERS, rise.tolist(), strict=True)),
        dict(zip(PARAMETERS, wide.tolist(), strict=True)),
    )
