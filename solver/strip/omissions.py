"""What the strip's model leaves out, with the size of each, from the state without couple."""

from __future__ import annotations

import numpy as np

from solver.omitted import OmittedTerm
from solver.strip.scene import StripScene
from solver.strip.state import StripState

GRAVITY_M_S2 = 9.80665
"""Standard gravity (CGPM 1901)."""

_LITTLE = 0.01
_NARROW = 1.0
"""w²κ/t below which a strip bends as a beam, with E; far above it as a plate, with E/(1 − ν²).

Searle, Experimental Elasticity (1908); Ashwell, J. R. Aeronaut. Soc. 54 (1950) 708.
"""


def searle_number(scene: StripScene, state: StripState) -> float:
    """w² κ/t at the state's largest curvature."""
    largest = float(np.abs(state.curvatures_per_m).max())
    return scene.width_m**2 * largest / scene.thickness_m


def plate_factor(scene: StripScene) -> float:
    """Stiffness of a strip that cannot bend across over that of one that can: 1/(1 − ν²)."""
    return 1 / (1 - scene.poisson**2)


def weight_share(scene: StripScene, state: StripState) -> float:
    """Weight times mean height of the arch, over its bending energy."""
    area = scene.width_m * scene.thickness_m
    weight = scene.density_kg_m3 * GRAVITY_M_S2 * area * scene.length_m
    return weight * abs(float(state.points_m[:, 1].mean())) / state.bending_J


def shortening_by_force(scene: StripScene, state: StripState) -> float:
    """Shortening P L/(E A) of the compressed beam, over the shortening that bends it."""
    area = scene.width_m * scene.thickness_m
    strain = state.force_N / (scene.modulus_Pa * area)
    return abs(strain) / scene.shortening


def sideways_share(scene: StripScene) -> float:
    """Stiffness against bending out of the strip's plane of bending's side, inverted: (t/w)²."""
    return (scene.thickness_m / scene.width_m) ** 2


def left_out(scene: StripScene, state: StripState) -> tuple[OmittedTerm, ...]:
    """List what is left out."""
    searle, weight = searle_number(scene, state), weight_share(scene, state)
    plate, squeeze = plate_factor(scene) - 1, shortening_by_force(scene, state)
    sideways = sideways_share(scene)
    strain = scene.thickness_m / 2 * float(np.abs(state.curvatures_per_m).max())
    return (
        OmittedTerm("bending across the width", "w² κ / t", searle, matters=searle > _NARROW),
        OmittedTerm(
            "stiffness of a wide strip",
            "1/(1 - ν²) - 1, at most",
            plate,
            matters=searle > _NARROW and plate > _LITTLE,
        ),
        OmittedTerm(
            "twist and bending sideways",
            "bending stiffness over that sideways, (t/w)²",
            sideways,
            matters=sideways > _LITTLE,
        ),
        OmittedTerm("weight", "work of the weight / bending energy", weight, weight > _LITTLE),
        OmittedTerm("stretch of the beam", "P L / (E A) / shortening", squeeze, squeeze > _LITTLE),
        OmittedTerm(
            "plastic bending", "largest bending strain at the surface", strain, strain > _LITTLE
        ),
    )
