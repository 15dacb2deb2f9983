"""The energy of a strip on the way from one stable state to the other, on either side.

Along the phase of its shape (`solver.strip.phase`): once around, from state + over the shape that
has the greater heading in its middle to state −, and back over that shape's mirror image. All else
has come to rest at each phase, so that the curve is level exactly where the strip is in balance.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.errors import NotConvergedError
from solver.strip.balance import Balance, Point, at_couple
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
    free = turned(balance, modes, Point(state.x, state.force, 0.0), 0.0)
    couple = scene.couple_N_m / scene.energy_unit_J
    held = Point(free.x, np.append(free.force[:2], 0.0), 0.0)
    point = _loaded(holding_phase(balance, modes, 0.0), held, couple)
    points: list[Point] = []
    phases = np.linspace(0, 2 * np.pi, samples)
    for phase in phases:
        point = turned(balance, modes, point, float(phase))
        points.append(point)
    return _read(scene, balance, modes, phases, points)


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
