"""The two readings of the fabric's strain-energy density.

Both have the form w(E) = a Tr(E²) + b (Tr E)², in units of E_f, with E the Green–Lagrange strain of
the sheet relative to its unstretched state.
"""

from __future__ import annotations

from enum import StrEnum

from solver.errors import SceneError


class Reading(StrEnum):
    """How the energy density is read.

    ``plane-stress`` is St. Venant–Kirchhoff elasticity of a thin sheet that is free to thin, what
    Surface Evolver's ``linear_elastic`` computes. ``published`` is Eq. 2 of the SESAME paper to the
    letter: twice the three-dimensional density, which diverges as ν → 1/2.
    """

    PLANE_STRESS = "plane-stress"
    PUBLISHED = "published"


def check_poisson(poisson: float, reading: Reading) -> None:
    """Raise `SceneError` unless the density is positive definite at this Poisson ratio.

    Plane stress allows the incompressible limit ν = 1/2 itself; the published reading does not.
    """
    below = poisson <= 0.5 if reading is Reading.PLANE_STRESS else poisson < 0.5
    if not (poisson > -1.0 and below):
        limit = "at most 0.5" if reading is Reading.PLANE_STRESS else "less than 0.5"
        raise SceneError(
            f"poisson = {poisson:g}: must be greater than -1 and {limit} ({reading} reading)"
        )


def density_coefficients(poisson: float, reading: Reading) -> tuple[float, float]:
    """Coefficients (a, b) of w = a Tr(E²) + b (Tr E)², in units of E_f.

    Plane stress: a = 1/(2(1+ν)), b = a ν/(1−ν) (docs/theory.md, eq. (3)). Published, Eq. 2 of the
    paper: a = 1/(1+ν), b = a ν/(1−2ν) (docs/theory.md, eq. (4)).
    """
    check_poisson(poisson, reading)
    if reading is Reading.PLANE_STRESS:
        a = 1 / (2 * (1 + poisson))
        return a, a * poisson / (1 - poisson)
    a = 1 / (1 + poisson)
    return a, a * poisson / (1 - 2 * poisson)


def density_slopes(poisson: float, reading: Reading) -> tuple[float, float]:
    """Derivatives of (a, b) by Poisson's ratio.

    With a = 1/(c(1+ν)) and b = a ν/(1 − mν): a' = −c a², b' = a' ν/(1 − mν) + a/(1 − mν)², where
    c = 2, m = 1 in plane stress, and c = 1, m = 2 in the published reading.
    """
    a, _ = density_coefficients(poisson, reading)
    c, m = (2, 1) if reading is Reading.PLANE_STRESS else (1, 2)
    by_a, room = -c * a**2, 1 - m * poisson
    return by_a, by_a * poisson / room + a / room**2
