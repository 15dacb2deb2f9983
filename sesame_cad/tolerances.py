"""What the tolerances of materials do to a loop's height: to first order, and by sampling."""

from __future__ import annotations

from dataclasses import asdict, dataclass, replace
from math import isclose, pi, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from sesame_cad.errors import InputError
from sesame_cad.loop_response import LoopDesign, loop_design, respond
from sesame_cad.measured import MEASURED, MeasuredArray
from sesame_cad.specification import Specification
from solver.many import solve_many
from solver.reading import Reading

Vectors = NDArray[np.float64]

MODULUS_SHARE = 0.1
STRAIN = 0.02
WIRE_MM = 0.02
SAMPLES = 512
"""A power of 2, as Sobol's sequence wants."""

_ROUNDING = 0.005
"""Half of the last digit to which the paper gives its measured heights."""


@dataclass(frozen=True, slots=True)
class Contribution:
    """What one tolerance does, to first order.

    Attributes
    ----------
    key : str
    tolerance : float
        In the key's unit; both ways.
    height_over_perimeter : float
        The change of the height for the upper end; its size is that of both.
    """

    key: str
    tolerance: float
    height_over_perimeter: float


@dataclass(frozen=True)
class HeightBand:
    """The height of a loop with its tolerances, over the wire's length.

    Attributes
    ----------
    state : str
    height : float
        With every number as it is specified.
    contributions : tuple of Contribution
    worst : float
        All contributions added up: to first order, the farthest that the height can go.
    likely : float
        Root of the sum of their squares over √3: the standard deviation of independent tolerances,
        each spread evenly.
    sampled : tuple of float
        Least, 2.5 %, 97.5 % and greatest of the sampled heights.
    first_order : tuple of float
        The same by the contributions alone, on the same samples.
    samples, unsolved : int
        Points that were sampled, and those of them that have no shape to rely on.
    """

    state: str
    height: float
    contributions: tuple[Contribution, ...]
    worst: float
    likely: float
    sampled: tuple[float, float, float, float]
    first_order: tuple[float, float, float, float]
    samples: int
    unsolved: int

    def verdict(self, measured: float) -> str:
        """Say whether a measured height lies among those of the samples.

        The paper gives two digits: a height that lies outside may still be inside before rounding.
        """
        low, _, _, high = self.sampled
        off = max(low - measured, measured - high)
        if off <= 0:
            return "inside"
        if off <= _ROUNDING:
            return f"outside by {off:.4f}, which rounding to two digits may make up"
        return f"outside by {off:.4f}"


def half_widths(design: LoopDesign) -> dict[str, float]:
    """Tolerance of each number: ±10 % of both moduli, ±0.02 of strain, ±0.02 mm of wire."""
    return {
        "wire_modulus_GPa": MODULUS_SHARE * design.wire_modulus_GPa,
        "fabric_modulus_kPa": MODULUS_SHARE * design.fabric_modulus_kPa,
        "prestrain": STRAIN,
        "wire_diameter_mm": WIRE_MM,
    }


def height_band(design: LoopDesign, state: str, tolerance: float = 1e-4) -> HeightBand:
    """Find how far the height may be from its specified value.

    Raises
    ------
    InputError
        When a tolerance is larger than its number.
    SceneError, NotConvergedError
        When the loop itself cannot be solved.
    """
    widths = half_widths(design)
    for key, width in widths.items():
        if getattr(design, key) <= width:
            raise InputError(
                f"{key} = {getattr(design, key):g}: not greater than its tolerance, {width:g}"
            )
    found = respond(design, tolerance)
    perimeter_mm = pi * design.loop_diameter_mm
    height = found.height_mm / perimeter_mm
    parts = tuple(
        Contribution(key, width, found.height_by[key] * width / perimeter_mm)
        for key, width in widths.items()
    )
    cube = 2 * qmc.Sobol(len(widths), scramble=False).random(SAMPLES) - 1
    linear = height + cube @ np.array([part.height_over_perimeter for part in parts])
    heights, unsolved = _sampled(design, widths, cube)
    changes = [part.height_over_perimeter for part in parts]
    return HeightBand(
        state,
        height,
        parts,
        worst=sum(map(abs, changes)),
        likely=sqrt(sum(change**2 for change in changes) / 3),
        sampled=_spread(heights),
        first_order=_spread(np.maximum(linear, 0)),
        samples=SAMPLES,
        unsolved=unsolved,
    )


def _sampled(design: LoopDesign, widths: dict[str, float], cube: Vectors) -> tuple[Vectors, int]:
    """Heights over perimeter of loops in the box of tolerances, those that have one."""
    scenes = [
        replace(
            design,
            **{
                key: getattr(design, key) + at * width
                for (key, width), at in zip(widths.items(), row, strict=True)
            },
        ).scene
        for row in cube.tolist()
    ]
    found = solve_many(
        [scene.strain for scene in scenes],
        [scene.beta for scene in scenes],
        design.poisson,
        Reading(design.reading),
        [scene.axial_stiffness for scene in scenes],
    )
    good = (found.status == "converged") & ~found.meets
    return found.height_over_perimeter[good], int((~good).sum())


def _spread(heights: Vectors) -> tuple[float, float, float, float]:
    low, high = np.quantile(heights, [0.025, 0.975]).tolist()
    return float(heights.min()), low, high, float(heights.max())


def measured_array(spec: Specification) -> MeasuredArray | None:
    """Give the paper's array that a design is: the same wire, loop and fabric; None for others."""
    for one in MEASURED:
        same = (
            (one.prestrain, spec.fabric.prestrain),
            (one.fabric_thickness_mm, spec.fabric.thickness_mm),
            (one.fabric_modulus_kPa, spec.fabric.modulus_kPa),
            (one.wire_modulus_cold_GPa, spec.wire.modulus_cold_GPa),
            (one.wire_diameter_mm, spec.wire.diameter_mm),
            (one.loop_diameter_mm, spec.layout.diameter_mm),
        )
        if all(isclose(theirs, ours, rel_tol=1e-9) for theirs, ours in same):
            return one
    return None


def tolerances_data(spec: Specification) -> dict[str, Any]:
    """Bands of the cold and the hot height, and what was measured if the design is the paper's.

    Raises
    ------
    InputError
        When the shape is not that of one cell.
    SceneError, NotConvergedError
        When a loop cannot be solved.
    """
    if spec.predicted_shape != "cell":
        raise InputError(
            f"{spec.name}: tolerances are reckoned for equal loops of which one is all there is to "
            f'solve, and this design\'s shape is "{spec.predicted_shape}"'
        )
    bands = [
        height_band(loop_design(spec, state), state, spec.model.tolerance)
        for state in ("cold", "hot")
    ]
    data: dict[str, Any] = {band.state: asdict(band) for band in bands}
    one = measured_array(spec)
    data["measured"] = one and {
        "array": one.name,
        "height_over_perimeter": one.height_over_perimeter,
        "lies": bands[0].verdict(one.height_over_perimeter),
    }
    return data
