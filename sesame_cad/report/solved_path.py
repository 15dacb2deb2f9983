"""The way from flat to cold and on to hot: shapes that are each solved, close to one another.

Released, the fabric bends the wire as far as the wire's stiffness lets it. A wire that is stiff
enough stays flat, as the hoop held it; the softer it is, the more the loop rises. So one family of
true equilibria, at the fabric's own prestrain, leads from the flat loop (a stiff wire) to the cold
shape, and part of it from the cold shape to the hot one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sesame_cad.specification import Specification
from sesame_cad.state import CellState, loop_materials, loop_scene
from solver.compact import solve_loop
from solver.equilibrium import Equilibrium
from solver.errors import NotConvergedError
from solver.flat import flat_radius, flat_shape
from solver.shape import LoopShape
from solver.threshold import critical_beta

Vectors = NDArray[np.float64]

RELEASE_STEPS, HEATING_STEPS = 8, 10
"""Shapes on each part of the way; between neighbours the page draws straight lines."""


@dataclass(frozen=True)
class PathState:
    """One solved loop on the way.

    Attributes
    ----------
    wire_modulus_GPa : float or None
        None of the loop as it is sewn, which no modulus makes exactly flat and round.
    shape : LoopShape
        In units of the loop's radius.
    radius_mm : float
        As it was laid.
    """

    wire_modulus_GPa: float | None  # noqa: N815 - the unit's name
    shape: LoopShape
    radius_mm: float

    @property
    def height_mm(self) -> float:
        """Rise of the wire's centreline."""
        return self.shape.height * self.radius_mm

    @property
    def pitch_mm(self) -> float:
        """Distance of neighbours' centres."""
        return self.shape.width * self.radius_mm


@dataclass(frozen=True)
class SolvedPath:
    """States in order, from the loop as it is sewn.

    Attributes
    ----------
    states : tuple of PathState
    cold : int
        Which of them is the cold one; the last is the hot one.
    whole : bool
        False where a shape between did not come out, so that no more than three are here.
    """

    states: tuple[PathState, ...]
    cold: int
    whole: bool


def solved_path(spec: Specification, cold: CellState, hot: CellState) -> SolvedPath:
    """Solve the shapes between flat, cold and hot."""
    ends = [_state(spec.wire.modulus_cold_GPa, cold), _state(spec.wire.modulus_hot_GPa, hot)]
    flat = _as_sewn(cold)
    release, heating = _moduli_between(spec, cold, hot)
    try:
        risen = _solved(spec, release, None)
        heated = _solved(spec, heating, cold.equilibrium)
    except NotConvergedError:
        return SolvedPath((flat, *ends), 1, whole=False)
    return SolvedPath((flat, *risen, ends[0], *heated, ends[1]), 1 + len(risen), whole=True)


def _moduli_between(
    spec: Specification, cold: CellState, hot: CellState
) -> tuple[list[float], list[float]]:
    """Moduli in GPa for the shapes before the cold one, and between the cold and the hot one.

    The height grows from the threshold as the root of what β is below it, so steps are equal in
    that root.
    """
    start, end = spec.wire.modulus_cold_GPa, spec.wire.modulus_hot_GPa
    threshold = critical_beta(
        spec.fabric.prestrain, spec.fabric.poisson, cold.equilibrium.scene.reading
    )
    flat_from = threshold * start / cold.materials.beta
    if start >= flat_from:  # flat all the way
        return [], np.linspace(start, end, HEATING_STEPS + 1)[1:-1].tolist()
    # 1 is the cold wire, 0 one that just stays flat
    released = np.linspace(0, 1, RELEASE_STEPS + 1)[:-1]
    lowest = float(np.sqrt(max(0.0, (flat_from - end) / (flat_from - start))))
    heated = np.linspace(1, lowest, HEATING_STEPS + 1)[1:]
    if end < flat_from:
        heated = heated[:-1]
    below = flat_from - start
    return (flat_from - below * released**2).tolist(), (flat_from - below * heated**2).tolist()


def _solved(
    spec: Specification,
    moduli_GPa: list[float],  # noqa: N803
    start: Equilibrium | None,
) -> list[PathState]:
    states: list[PathState] = []
    for modulus in moduli_GPa:
        materials = loop_materials(spec, modulus)
        start = solve_loop(loop_scene(spec, materials), tolerance=spec.model.tolerance, start=start)
        states.append(PathState(modulus, start.shape, materials.loop_radius_m * 1e3))
    return states


def _state(modulus_GPa: float, state: CellState) -> PathState:  # noqa: N803
    return PathState(modulus_GPa, state.equilibrium.shape, state.radius_mm)


def _as_sewn(state: CellState) -> PathState:
    """Give the round disc: the flat loop, without what its wire gives way."""
    scene = state.equilibrium.scene
    flat = flat_shape(scene, state.equilibrium.degree)
    disc = LoopShape(flat.unknowns, flat.coefficients / flat_radius(scene))
    return PathState(None, disc, state.radius_mm)
