"""What is to be solved: a beam strip, the shorter strip that bends it, and two sleeves' couples."""

from __future__ import annotations

import math
from dataclasses import dataclass

from solver.errors import SceneError
from solver.strip.ends import Ends

SMALLEST_SHORTENING = 1e-9
"""Share of the length; with less, the difference of two lengths has too few digits."""
LARGEST_SHORTENING = 0.99
"""Share of the length; with more, the ends meet, and nothing keeps the strip from turning."""
SHORTEST_SLEEVE = 0.01
"""Share of the length."""
LARGEST_STIFFENING = 100.0
"""Stiffness of the sleeves over the beam's; with more, half of the beam is rigid."""

_WHOLE_TURN = 2 * math.pi
_MANY_TIMES_CRITICAL = 30.0
"""Largest couple × covered share / (√δ EI/L); one on half of a pinned strip snaps it at 3.5."""


@dataclass(frozen=True, slots=True)
class StripScene:
    """A flat strip along x between two rivets, which a shorter strip holds closer than its length.

    Lengths in m, moduli in Pa, couples in N m. The strip bends in the plane and does not stretch.
    A sleeve's couple is the uniform bending moment with which it loads the strip wherever it covers
    it: couples of ±M at the sleeve's ends. That of the top sleeve, greater than 0 when the sleeve
    pushes its ends apart, bends the strip's ends down; that of the bottom sleeve bends them up.

    Attributes
    ----------
    length_m : float
        Of the beam between its rivets.
    constraint_m : float
        Of the shorter strip between the same rivets.
    width_m, thickness_m : float
        Of the beam.
    modulus_Pa, poisson : float
        Of the beam; by default those of polycarbonate (2.35 GPa; 0.37, makers' data sheets).
    density_kg_m3 : float
        Of the beam (polycarbonate: 1200, makers' data sheets), for what gravity would do.
    couple_top_N_m, couple_bottom_N_m : float
        Of sleeves on the straight beam.
    sleeve_stiffness_N_m2 : float
        By which couples fall with the curvature that lengthens their sleeves, both together, N m
        per 1/m: a bending stiffness that the covered part has on top of the beam's.
    covered : tuple of float
        Where the sleeves begin and end, as shares of the length, in one half of the beam.
    ends : Ends

    Raises
    ------
    SceneError
        When a number is out of its range.
    """

    length_m: float
    constraint_m: float
    width_m: float
    thickness_m: float
    modulus_Pa: float = 2.35e9  # noqa: N815 - the units' own names
    poisson: float = 0.37
    density_kg_m3: float = 1200.0
    couple_top_N_m: float = 0.0  # noqa: N815
    couple_bottom_N_m: float = 0.0  # noqa: N815
    sleeve_stiffness_N_m2: float = 0.0  # noqa: N815
    covered: tuple[float, float] = (0.0, 0.5)
    ends: Ends = Ends.PINNED

    def __post_init__(self) -> None:
        for key in ("length_m", "constraint_m", "width_m", "thickness_m", "modulus_Pa"):
            _check_positive(key, getattr(self, key))
        _check_positive("density_kg_m3", self.density_kg_m3)
        if not -1 < self.poisson < 0.5:
            raise SceneError(f"poisson = {self.poisson:g}: must lie between -1 and 0.5")
        if not 0 <= self.stiffening <= LARGEST_STIFFENING:
            raise SceneError(
                f"sleeve_stiffness_N_m2 = {self.sleeve_stiffness_N_m2:g}: must be from 0 to "
                f"{LARGEST_STIFFENING:g} times the beam's, {self.stiffness_N_m2:g} N m²"
            )
        self._check_shortening()
        self._check_covered()
        self._check_couple()

    def _check_shortening(self) -> None:
        if self.constraint_m >= self.length_m:
            raise SceneError(
                f"constraint_m = {self.constraint_m:g}: must be less than length_m = "
                f"{self.length_m:g}, or the beam stays flat"
            )
        if not SMALLEST_SHORTENING <= self.shortening <= LARGEST_SHORTENING:
            raise SceneError(
                f"constraint_m = {self.constraint_m:g}: must be shorter than length_m = "
                f"{self.length_m:g} by {SMALLEST_SHORTENING:g} to {LARGEST_SHORTENING:g} of it"
            )

    def _check_covered(self) -> None:
        begin, end = self.covered
        in_a_half = 0 <= begin < end <= 0.5 or 0.5 <= begin < end <= 1
        if not (in_a_half and end - begin >= SHORTEST_SLEEVE):
            raise SceneError(
                f"covered = ({begin:g}, {end:g}): must lie in 0 to 0.5 or in 0.5 to 1 and be at "
                f"least {SHORTEST_SLEEVE:g} long: a sleeve covers no more than half of the beam"
            )

    def _check_couple(self) -> None:
        for key in ("couple_top_N_m", "couple_bottom_N_m"):
            if not math.isfinite(getattr(self, key)):
                raise SceneError(f"{key} = {getattr(self, key):g}: must be finite")
        if abs(self.couple_N_m) > self.largest_couple_N_m:
            raise SceneError(
                f"couple_bottom_N_m - couple_top_N_m = {self.couple_N_m:g}: must be within "
                f"±{self.largest_couple_N_m:g} for this beam"
            )

    @property
    def shortening(self) -> float:
        """δ, as a share of the length."""
        return (self.length_m - self.constraint_m) / self.length_m

    @property
    def stiffness_N_m2(self) -> float:  # noqa: N802
        """EI = E w t³/12."""
        return self.modulus_Pa * self.width_m * self.thickness_m**3 / 12

    @property
    def stiffening(self) -> float:
        """Bending stiffness of the sleeves in units of EI."""
        return self.sleeve_stiffness_N_m2 / self.stiffness_N_m2

    @property
    def energy_unit_J(self) -> float:  # noqa: N802
        """EI/L, the unit of energies and of couples."""
        return self.stiffness_N_m2 / self.length_m

    @property
    def couple_N_m(self) -> float:  # noqa: N802
        """Sum of both sleeves' couples; greater than 0 where it bends the ends up."""
        return self.couple_bottom_N_m - self.couple_top_N_m

    @property
    def largest_couple_N_m(self) -> float:  # noqa: N802
        """Couple up to which states are followed.

        It would curl the covered part alone into a circle that meets itself, or is many times the
        couple at which a strip as little bent as this one snaps.
        """
        turn = min(_WHOLE_TURN, _MANY_TIMES_CRITICAL * math.sqrt(self.shortening))
        stiff = (1 + self.stiffening) * self.energy_unit_J
        return turn / (self.covered[1] - self.covered[0]) * stiff


def _check_positive(key: str, value: float) -> None:
    if not (value > 0 and math.isfinite(value)):
        raise SceneError(f"{key} = {value:g}: must be greater than 0 and finite")
