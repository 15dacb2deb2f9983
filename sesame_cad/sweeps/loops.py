"""Sweeps of one dimensionless loop, solved many at a time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sesame_cad.sweeps.outcome import Outcome
from solver.many import Equilibria, solve_many
from solver.reading import Reading
from solver.scene import LoopScene

Vectors = NDArray[np.float64]

KEYS = ("strain", "beta", "poisson", "axial_stiffness")

HIGHEST_DEGREE = 13
"""Of the bases for loops that must be solved alone: those have slack fabric, and larger bases take
ten times as long to say no more than that."""


@dataclass(frozen=True, slots=True)
class LoopModel:
    """One dimensionless loop; every one of `KEYS` is an axis.

    Attributes
    ----------
    reading : str
    tolerance : float
        Of the height's relative change from basis to basis.
    points_at_once : int
        Points of a chunk.
    """

    reading: str
    tolerance: float
    points_at_once: int = 1024

    def description(self) -> dict[str, Any]:
        """Say what it is, as plain data."""
        return {"model": "loop", **asdict(self)}

    def check(self, keys: Sequence[str], point: Sequence[float]) -> None:
        """Raise `SceneError` where the model does not reach."""
        given = dict(zip(keys, point, strict=True))
        LoopScene(**given, reading=Reading(self.reading))

    def solve(self, keys: Sequence[str], points: Sequence[tuple[float, ...]]) -> list[Outcome]:
        """Solve points, all at once."""
        given = dict(zip(keys, np.array(points).T, strict=True))
        return solve_loops(given, self.reading, self.tolerance)


def solve_loops(given: Mapping[str, Vectors], reading: str, tolerance: float) -> list[Outcome]:
    """Solve loops at once, from an array (B,) for each of `KEYS`."""
    strain, beta, poisson, axial_stiffness = (given[key] for key in KEYS)
    found = solve_many(
        strain,
        beta,
        poisson,
        Reading(reading),
        axial_stiffness,
        tolerance=tolerance,
        highest_degree=HIGHEST_DEGREE,
    )
    loops = zip(strain.tolist(), beta.tolist(), poisson.tolist(), strict=True)
    return [_outcome(found, i, *loop) for i, loop in enumerate(loops)]


def _outcome(found: Equilibria, i: int, strain: float, beta: float, poisson: float) -> Outcome:
    return Outcome(
        strain,
        beta,
        poisson,
        height_over_perimeter=float(found.height_over_perimeter[i]),
        pitch_over_diameter=float(found.width[i]) / 2,
        energy=float(found.energy[i]),
        smallest_stress=float(found.smallest_stress[i]),
        buckled=bool(found.buckled[i]),
        # a fabric without prestrain has no stress but for rounding
        slack=bool(found.slack[i]) and strain > 0,
        self_meeting=bool(found.meets[i]),
        status=str(found.status[i]),
    )
