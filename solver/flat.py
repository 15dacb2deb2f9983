"""The flat state of a circular loop on isotropic fabric: the disc, a little smaller."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from solver.disc_functions import DiscFunction
from solver.reading import density_coefficients
from solver.scene import LoopScene
from solver.shape import LoopShape, from_expansion
from solver.symmetry import saddle

Vectors = NDArray[np.float64]


def flat_radius(scene: LoopScene) -> float:
    """Radius of the flat loop in equilibrium, in units of the radius it was laid with.

    Uniform contraction is an exact solution: it minimises
    U(a) = π (2 c₁ + 4 c₂) e²/(1+ε)² + 2πβ a (1/a − κ0)² + π k (a − 1)², e = ((1+ε)² a² − 1)/2,
    with c₁, c₂ the coefficients of the density.
    """
    c1, c2 = density_coefficients(scene.poisson, scene.reading)
    stretch = (1 + scene.strain) ** 2

    def slope(a: float) -> float:
        fabric = (2 * c1 + 4 * c2) * (stretch * a * a - 1) * a
        bending = 2 * scene.beta * (scene.natural_curvature**2 - 1 / a**2)
        return fabric + bending + 2 * scene.axial_stiffness * (a - 1)

    # the slope is negative near 0 and positive where the wire's stretch outweighs its bending
    return float(
        brentq(slope, 1e-9, 2 + scene.beta / scene.axial_stiffness, xtol=1e-15, rtol=1e-15)
    )


def flat_shape(scene: LoopScene, degree: int) -> LoopShape:
    """Give the flat equilibrium as a member of the saddle's shapes."""
    half_radius = flat_radius(scene) / 2  # x itself has mean square 1/4 over the disc
    unknowns = saddle(degree)
    return LoopShape(
        unknowns,
        from_expansion(
            unknowns,
            {
                (0, DiscFunction(1, 0, "cos")): half_radius,
                (1, DiscFunction(1, 0, "sin")): half_radius,
            },
        ),
    )


def rising_stiffness(scene: LoopScene, waves: Vectors) -> Vectors:
    """Second variation of the flat state along z = r^n cos nθ, n = ``waves`` (N,), exactly.

    Harmonic functions are the lowest motions out of the plane, since the flat fabric's tension S is
    the same everywhere. The energy is π c² n (n − 1) (n (n + 1) β (1/a³ − κ0/a²) − S/2), a being
    the flat radius; here it is scaled to a mean square of 1 over the disc.
    """
    a, n = flat_radius(scene), waves
    c1, c2 = density_coefficients(scene.poisson, scene.reading)
    tension = (c1 + 2 * c2) * (((1 + scene.strain) * a) ** 2 - 1)
    bending = scene.beta * (1 / a - scene.natural_curvature) / a**2
    return 4 * np.pi * (n + 1) * n * (n - 1) * (n * (n + 1) * bending - tension / 2)
