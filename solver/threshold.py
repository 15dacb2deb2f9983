"""When a flat loop stops being flat: exact results.

A flat inextensible ring that spans a membrane of isotropic line tension T loses stability out of
plane in mode n ≥ 2 when T = 2 β n (n + 1): the second variation is π T a² (n − n²)/2 from the
membrane and β π a² n² (n² − 1) from the ring. The saddle, n = 2, comes first: T = 12 β.
"""

from __future__ import annotations

import math

from solver.reading import Reading, density_coefficients

SADDLE_MODE = 2


def line_tension(strain: float, poisson: float, reading: Reading) -> float:
    """Tension T of the flat fabric, in units of E_f t.

    With e = ((1+ε)² − 1)/2 and w = a Tr E² + b (Tr E)², T = 2 (a + 2b) e: e/(1−ν) in the
    plane-stress reading, 2e/((1+ν)(1−2ν)) in the published one (docs/theory.md, eq. (5)).
    """
    a, b = density_coefficients(poisson, reading)
    return (a + 2 * b) * ((1 + strain) ** 2 - 1)


def critical_beta(
    strain: float, poisson: float, reading: Reading, mode: int = SADDLE_MODE
) -> float:
    """β below which the flat loop buckles into ``mode`` (≥ 2), for an inextensible wire.

    That of docs/theory.md, eq. (6).
    """
    return line_tension(strain, poisson, reading) / (2 * mode * (mode + 1))


def critical_strain(
    beta: float, poisson: float, reading: Reading, mode: int = SADDLE_MODE
) -> float:
    """Strain above which the flat loop buckles into ``mode`` (≥ 2), for an inextensible wire.

    From docs/theory.md, eq. (5) and eq. (6).
    """
    a, b = density_coefficients(poisson, reading)
    return math.sqrt(1 + 2 * mode * (mode + 1) * beta / (a + 2 * b)) - 1
