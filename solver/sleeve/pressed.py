"""A loop of a sleeve at a pitch: its force along the beam, and the stripe's pull across it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.compact import solve_loop
from solver.errors import NotConvergedError, SceneError
from solver.held import HeldEquilibrium, Pitch, solve_at_pitch
from solver.sleeve.cell import SleeveCell

Vectors = NDArray[np.float64]

TOLERANCE = 1e-3
"""Of force and height, relative, from basis to basis."""

SHORTEST_PITCH = 0.2
"""Share of the sewn diameter; nearer crests have next to no room for their own wires."""

_SAMPLES = 65


@dataclass(frozen=True)
class PressedLoop:
    """A loop at a pitch, in SI units; z points away from the beam.

    Attributes
    ----------
    cell : SleeveCell
    pitch_m : float
        Distance of its crests, at which its neighbours stand.
    held : HeldEquilibrium
        The dimensionless shape.
    """

    cell: SleeveCell
    pitch_m: float
    held: HeldEquilibrium

    @property
    def force_N(self) -> float:  # noqa: N802 - the units' own names
        """Push along the beam, −dU/dpitch (docs/theory.md, eq. (17)); < 0 where the bonds pull."""
        return self.held.force * self.cell.materials.force_unit_N

    @property
    def energy_J(self) -> float:  # noqa: N802
        """Energy of the loop."""
        return self.held.energy * self.cell.materials.energy_unit_J

    @property
    def crest_height_m(self) -> float:
        """Rise of the crests, where neighbours press on each other, over the valleys."""
        crest, valley = self.points_m(np.ones(2), np.array([0.0, np.pi / 2]))
        return float(crest[2] - valley[2])

    @property
    def valley_distance_m(self) -> float:
        """Distance of the valleys across the beam."""
        return 2 * float(self.points_m(np.ones(1), np.array([np.pi / 2]))[0, 1])

    @property
    def stripe_taut(self) -> bool:
        """Whether the stripe holds the valleys together."""
        hold = self.held.hold
        return isinstance(hold, Pitch) and hold.width is not None

    @property
    def stripe_tension_N(self) -> float:  # noqa: N802
        """Pull of the stripe; 0 where it is slack."""
        return max(0.0, self.held.force_across) * self.cell.materials.force_unit_N

    @property
    def stripe_path_m(self) -> float:
        """Length of the fabric's line from valley to valley."""
        radius = np.concatenate([np.linspace(1, 0, _SAMPLES), np.linspace(0, 1, _SAMPLES)[1:]])
        side = np.where(np.arange(len(radius)) < _SAMPLES, 1, -1)
        line = self.points_m(radius, side * np.pi / 2)
        return float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum())

    def points_m(self, radius: Vectors, angle_rad: Vectors) -> Vectors:
        """Positions (n, 3) of points at polar coordinates of the flat loop's unit disc."""
        radius_m = self.cell.materials.loop_radius_m
        return radius_m * self.held.shape.position(radius, angle_rad)


def free_pitch_m(cell: SleeveCell) -> float:
    """Distance of the crests when nothing holds the row.

    Raises
    ------
    NotConvergedError
        When the free loop has no shape to rely on.
    """
    return solve_loop(cell.scene).shape.width * cell.materials.loop_radius_m


def press(
    cell: SleeveCell,
    pitch_m: float,
    *,
    start: PressedLoop | None = None,
    tolerance: float = TOLERANCE,
) -> PressedLoop:
    """Hold a loop at a pitch.

    The loop is solved without its stripe first, and with the stripe's length prescribed where its
    valleys came out farther apart: then it is taut, for the energy falls with their distance.

    Parameters
    ----------
    start : PressedLoop, optional
        At a neighbouring pitch or temperature, from which the solve takes less time.

    Raises
    ------
    SceneError
        When the pitch is out of range.
    NotConvergedError
        When there is no shape to rely on at this pitch.
    """
    radius = cell.materials.loop_radius_m
    shortest = 2 * SHORTEST_PITCH * radius
    if not shortest <= pitch_m < np.pi * radius:
        raise SceneError(
            f"pitch_m = {pitch_m:g}: must be at least {shortest:g} and less than "
            f"{np.pi * radius:g}, half of the wire's length"
        )
    known = start.held if start else None
    try:
        held = solve_at_pitch(cell.scene, Pitch(pitch_m / radius), tolerance=tolerance, start=known)
        pressed = PressedLoop(cell, pitch_m, held)
        if cell.stripe_m is not None and pressed.valley_distance_m > cell.stripe_m:
            hold = Pitch(pitch_m / radius, cell.stripe_m / radius)
            held = solve_at_pitch(cell.scene, hold, tolerance=tolerance, start=held)
            pressed = PressedLoop(cell, pitch_m, held)
    except NotConvergedError as error:
        raise NotConvergedError(
            f"a loop held at a pitch of {pitch_m * 1e3:g} mm: {error}"
        ) from None
    return pressed


def press_along(
    cell: SleeveCell, pitches_m: Iterable[float], *, tolerance: float = TOLERANCE
) -> Iterator[PressedLoop]:
    """Hold a loop at one pitch after the other: the curve of force against pitch.

    Raises
    ------
    SceneError, NotConvergedError
        As `press`.
    """
    pressed: PressedLoop | None = None
    for pitch_m in pitches_m:
        pressed = press(cell, pitch_m, start=pressed, tolerance=tolerance)
        yield pressed
