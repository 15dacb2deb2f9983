"""The energy of a strip on the way from one stable state to the other, on either side.

Along the phase of its shape (`solver.strip.phase`): once around, from state + over the shape that
has the greater heading in its middle to state −, and back over that shape's mirror image. All else
has come to rest at each phase, so that the curve is level exactly where the strip is in balance.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.errors import NotConvergedError, SceneError
from solver.strip.balance import Balance, Point, at_couple
from solver.strip.mirror import mirrored
from solver.strip.phase import amplitudes, at_rest, first_state, holding_phase, turned
from solver.strip.scene import StripScene
from solver.strip.snap import scene_basis
from solver.strip.state import positions

Vectors = NDArray[np.float64]

_PARTS = 8
_SMALLEST_PART = 1e-3


@dataclass(frozen=True)
class Landscape:
    """Energy along the phase of the shape, at one couple.

    Attributes
    ----------
    phase_rad : array (n,)
        From 0 to 2π, both included: the way is closed.
    energy_J : array (n,)
        Bending energy less the couple's work.
    slope_J : array (n,)
        dU/dφ.
    height_m : array (n,)
        y halfway along the beam.
    """

    phase_rad: Vectors
    energy_J: Vectors  # noqa: N815 - the units' own names
    slope_J: Vectors  # noqa: N815
    height_m: Vectors


def _loaded(held: Balance, start: Point, couple: float) -> Point:
    """Bring the couple on by parts, shorter ones where they must be."""
    point, part = start, couple / _PARTS
    while point.couple != couple:
        left = couple - point.couple
        to = couple if abs(left) <= abs(part) * (1 + 1e-9) else point.couple + part
        try:
            point = at_couple(held, point, to)
        except NotConvergedError:
            part /= 2
            if abs(part) < _SMALLEST_PART * abs(couple):
                raise
    return point


def energy_landscape(scene: StripScene, samples: int = 73) -> Landscape:
    """Trace the energy once around, at the scene's couple.

    Parameters
    ----------
    samples : int
        Number of phases, equally spaced.

    Raises
    ------
    NotConvergedError
        Where no shape comes to rest at a phase, as under couples far beyond the critical ones.
    """
    basis = scene_basis(scene)
    balance, modes = at_rest(basis, scene.shortening), amplitudes(basis, scene.ends)
    state = first_state(balance, scene.ends)
    point = _at_phase(scene, balance, modes, state, 0.0)
    points: list[Point] = []
    phases = np.linspace(0, 2 * np.pi, samples)
    for phase in phases:
        point = turned(balance, modes, point, float(phase))
        points.append(point)
    return _read(scene, balance, modes, phases, points)


def energy_to_minus(scene: StripScene, samples: int = 73) -> Landscape:
    """Trace the energy from state + to state −, on the side to which a couple above 0 bends it.

    It is traced from state −, which such a couple only bends further its own way, so that couples
    at which state + is gone are no hindrance. Phases are given as they fall behind, from 0 to π.

    Parameters
    ----------
    samples : int
        Number of phases, equally spaced.

    Raises
    ------
    SceneError
        When the couple is less than 0.
    NotConvergedError
        Where no shape comes to rest at a phase.
    """
    if scene.couple_N_m < 0:
        raise SceneError(
            f"couple_bottom_N_m - couple_top_N_m = {scene.couple_N_m:g}: must be at least 0 for "
            "the way from state + to state -; mirror the scene"
        )
    basis = scene_basis(scene)
    balance, modes = at_rest(basis, scene.shortening), amplitudes(basis, scene.ends)
    state = mirrored(first_state(balance, scene.ends))
    point = _at_phase(scene, balance, modes, state, np.pi)
    points: list[Point] = []
    phases = np.linspace(np.pi, 2 * np.pi, samples)
    for phase in phases:
        point = turned(balance, modes, point, float(phase))
        points.append(point)
    found = _read(scene, balance, modes, phases, points)
    return Landscape(
        2 * np.pi - phases[::-1], found.energy_J[::-1], -found.slope_J[::-1], found.height_m[::-1]
    )


def _at_phase(
    scene: StripScene, balance: Balance, modes: Vectors, state: Point, phase: float
) -> Point:
    """Turn a state without couple to a phase, and bring the scene's couple on there."""
    free = turned(balance, modes, Point(state.x, state.force, 0.0), phase)
    held = Point(free.x, np.append(free.force[:2], 0.0), 0.0)
    couple = scene.couple_N_m / scene.energy_unit_J
    return _loaded(holding_phase(balance, modes, phase), held, couple)


def _read(
    scene: StripScene, balance: Balance, modes: Vectors, phases: Vectors, points: list[Point]
) -> Landscape:
    unit, middle = scene.energy_unit_J, np.array([0.5])
    energy = [balance.energy(p.x, p.couple) for p in points]
    # the row that holds the phase turns at the rate of the amplitude
    slope = [p.force[2] * float(np.linalg.norm(modes @ p.x)) for p in points]
    height = [positions(balance.basis, p.x, middle)[0, 1] for p in points]
    return Landscape(
        phases, unit * np.array(energy), unit * np.array(slope), scene.length_m * np.array(height)
    )
