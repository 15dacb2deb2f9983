"""The flat state of a loop: the disc, a little smaller as the wire gives way."""

from __future__ import annotations

from scipy.optimize import brentq

from solver.disc_functions import DiscFunction
from solver.reading import density_coefficients
from solver.scene import LoopScene
from solver.shape import LoopShape, from_expansion
from solver.symmetry import saddle


def flat_radius(scene: LoopScene) -> float:
    """Radius of the flat loop in equilibrium, in units of the radius it was laid with.

    Uniform contraction is an exact solution: it minimises
    U(a) = π (2 c₁ + 4 c₂) e²/(1+ε)² + 2πβ/a + π k (a − 1)², e = ((1+ε)² a² − 1)/2,
    with c₁, c₂ the coefficients of the density.
    """
    c1, c2 = density_coefficients(scene.poisson, scene.reading)
    stretch = (1 + scene.strain) ** 2

    def slope(a: float) -> float:
        fabric = (2 * c1 + 4 * c2) * (stretch * a * a - 1) * a
        wire = -2 * scene.beta / a**2 + 2 * scene.axial_stiffness * (a - 1)
        return fabric + wire

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
