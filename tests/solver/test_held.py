"""A loop between plates: against figures of a mesh with springy plates, and against itself.

Lengths are given in mm for R = 25 mm, forces in N for E_f t R = 4.73 N.
"""

from dataclasses import replace

import numpy as np
import pytest

from solver.compact import solve_loop
from solver.errors import NotConvergedError, SceneError
from solver.held import held_path, solve_at_pitch, solve_between_plates
from solver.held_account import TILT
from solver.plates import Pitch, PlateAxis, Plates
from solver.scene import LoopScene

COLD = LoopScene(0.3, 0.01454, 0.3)
HOT = replace(COLD, beta=2.68 * COLD.beta)
STIFF = replace(COLD, beta=0.05)  # flat when it is free
R_MM, FORCE_N = 25.0, 4.73
SAME_BASIS = 0.5
"""A tolerance that ends every solve in the second basis."""


def _omitted(found, term):
    return next(left for left in found.omitted if left.term == term)


@pytest.mark.parametrize(
    ("scene", "gap_mm", "force_N"),
    [(COLD, 30, 0.32), (HOT, 30, 1.46), (COLD, 20, 1.2), (HOT, 20, 3.3)],
)
def test_figures_of_a_mesh(scene, gap_mm, force_N):
    found = solve_between_plates(scene, Plates(gap_mm / R_MM))
    assert found.status == "converged"
    assert found.force * FORCE_N == pytest.approx(force_N, rel=0.05)


@pytest.mark.parametrize("scene", [COLD, HOT])
@pytest.mark.parametrize(
    ("axis", "gap_mm"),
    [(PlateAxis.LATERAL, 34), (PlateAxis.LATERAL, 25), (PlateAxis.HEIGHT, 4.5)],
)
def test_force_is_what_the_energy_changes_by(scene, axis, gap_mm):
    gap, step = gap_mm / R_MM, 1e-3
    at, wide, narrow = (
        solve_between_plates(scene, Plates(g, axis), tolerance=SAME_BASIS)
        for g in (gap, gap + step, gap - step)
    )
    assert wide.unknowns == narrow.unknowns == at.unknowns
    assert at.force > 1e-3
    by_energy = (narrow.energy - wide.energy) / (2 * step)
    assert by_energy == pytest.approx(at.force, rel=1e-4)
    assert at.gradient_norm < 1e-8


@pytest.mark.parametrize("width", [None, 1.4])
def test_forces_of_bonds_are_what_the_energy_changes_by(width):
    step = 1e-3
    at = solve_at_pitch(COLD, Pitch(1.3, width), tolerance=SAME_BASIS)
    wide, narrow = (
        solve_at_pitch(COLD, Pitch(1.3 + d, width), tolerance=SAME_BASIS) for d in (step, -step)
    )
    assert (narrow.energy - wide.energy) / (2 * step) == pytest.approx(at.force, rel=1e-4)
    assert at.shape.position(1.0, 0.0)[0, 0] == pytest.approx(0.65, abs=1e-9)
    if width is not None:
        assert at.shape.position(1.0, np.pi / 2)[0, 1] == pytest.approx(0.7, abs=1e-9)
        pulled = [
            solve_at_pitch(COLD, Pitch(1.3, width + d), tolerance=SAME_BASIS).energy
            for d in (step, -step)
        ]
        by_energy = (pulled[1] - pulled[0]) / (2 * step)
        assert by_energy == pytest.approx(at.force_across, rel=1e-4)


def test_bonds_where_they_are_anyway_need_no_force():
    free = solve_between_plates(COLD, Plates(3.0), tolerance=1e-4)
    found = solve_at_pitch(COLD, Pitch(free.widths[0]), tolerance=1e-4)
    assert abs(found.force) < 1e-4
    wide, narrow = (solve_at_pitch(COLD, Pitch(free.widths[0] + d)).force for d in (0.05, -0.05))
    assert wide < 0 < narrow


@pytest.mark.parametrize("axis", list(PlateAxis))
def test_contacts_carry_the_force(axis):
    found = solve_between_plates(COLD, Plates(0.6 if axis is PlateAxis.HEIGHT else 1.0, axis))
    upper, lower = (sum(c.force for c in found.contacts if c.upper is up) for up in (True, False))
    assert all(contact.force > 0 for contact in found.contacts)
    assert upper == pytest.approx(found.force, rel=1e-9)
    if axis is PlateAxis.HEIGHT:
        assert lower == pytest.approx(found.force, rel=1e-9)


@pytest.mark.parametrize("axis", list(PlateAxis))
def test_nothing_passes_a_plate(axis):
    gap, thick = 0.6 if axis is PlateAxis.HEIGHT else 0.9, 0.02
    found = solve_between_plates(COLD, Plates(gap, axis, wire_diameter=thick))
    wire = found.shape.edge(4000)[:, axis.component]
    assert np.abs(wire).max() == pytest.approx((gap - thick) / 2, abs=1e-6)
    assert found.overlap < 1e-9
    r, theta = (grid.ravel() for grid in np.meshgrid(np.linspace(0, 1, 40), np.linspace(0, 6, 90)))
    assert np.abs(found.shape.position(r, theta)[:, axis.component]).max() < gap / 2


def test_where_they_touch_is_on_the_plate():
    found = solve_between_plates(COLD, Plates(1.0))
    (contact,) = found.contacts
    x, slope = (found.shape.curve.position(np.array([contact.angle_rad]), d)[0, 0] for d in (0, 1))
    assert x == pytest.approx(0.5, abs=1e-9)
    assert slope == pytest.approx(0, abs=1e-8)
    assert contact.angle_rad > 0.3  # the crest itself has left the plate


def test_a_quarter_turn_changes_nothing():
    one, other = (
        solve_between_plates(COLD, Plates(1.1, axis))
        for axis in (PlateAxis.LATERAL, PlateAxis.ACROSS)
    )
    assert one.force == pytest.approx(other.force, rel=1e-9)
    assert one.widths == pytest.approx(other.widths[::-1], rel=1e-9)
    assert one.lowest_eigenvalue == pytest.approx(other.lowest_eigenvalue, rel=1e-6)


def test_only_the_room_for_the_centreline_counts():
    thin, thick = (
        solve_between_plates(COLD, Plates(1.1 + d, wire_diameter=d)) for d in (0.0, 0.02)
    )
    assert thick.force == pytest.approx(thin.force, rel=1e-9)


@pytest.mark.parametrize("scene", [COLD, HOT])
@pytest.mark.parametrize("axis", list(PlateAxis))
def test_a_wide_gap_leaves_the_loop_free(scene, axis):
    free = solve_loop(scene, tolerance=1e-6)
    found = solve_between_plates(scene, Plates(3.0, axis), tolerance=1e-5)
    assert found.force == 0
    assert found.contacts == ()
    assert found.height == pytest.approx(free.shape.height, rel=1e-5)
    assert found.energy == pytest.approx(free.energy, rel=1e-6)
    assert found.lowest_eigenvalue == pytest.approx(free.lowest_eigenvalue, rel=1e-3)
    assert found.tilt_eigenvalue == found.lowest_eigenvalue


def test_force_starts_from_nothing_and_grows_as_plates_close():
    free = solve_between_plates(COLD, Plates(3.0))
    gaps = free.widths[0] - np.linspace(0.001, 0.6, 9)
    force = [found.force for found in held_path((COLD, Plates(float(g))) for g in gaps)]
    assert 0 < force[0] < 5e-4
    assert np.all(np.diff(force) > 0)


def test_a_path_ends_where_a_single_solve_does():
    betas = np.linspace(COLD.beta, HOT.beta, 6)
    *_, last = held_path((replace(COLD, beta=float(b)), Plates(1.2)) for b in betas)
    alone = solve_between_plates(HOT, Plates(1.2))
    assert last.force == pytest.approx(alone.force, rel=5e-3)
    assert last.height == pytest.approx(alone.height, rel=5e-3)


def test_pressing_flat_takes_less_force_at_the_end():
    """The flat loop is an equilibrium, if an unstable one, and needs no force at all."""
    gaps = [0.75, 0.5, 0.2, 0.05]
    force = [found.force for found in held_path((COLD, Plates(g, PlateAxis.HEIGHT)) for g in gaps)]
    assert force[0] < force[1] > force[2] > force[3] > 0


def test_a_flat_loop_between_plates():
    flat = solve_between_plates(STIFF, Plates(0.01, PlateAxis.HEIGHT))
    assert (flat.force, flat.height, flat.contacts) == (0, 0, ())
    assert flat.lowest_eigenvalue > 0
    buckled = solve_between_plates(STIFF, Plates(1.6))
    assert buckled.height > 0.4
    assert buckled.force > 0.2


def test_a_tighter_tolerance_changes_no_more_than_was_allowed():
    rough, fine = (solve_between_plates(COLD, Plates(1.2), tolerance=t) for t in (1e-2, 1e-3))
    assert rough.unknowns < fine.unknowns
    assert fine.change <= 1e-3
    assert rough.force == pytest.approx(fine.force, rel=1e-2)


@pytest.mark.parametrize("stiffness", [50.0, 1e5])
def test_soft_and_stiff_wire(stiffness):
    scene = replace(COLD, axial_stiffness=stiffness)
    found = solve_between_plates(scene, Plates(1.2), tolerance=2e-2)
    assert found.gradient_norm < 1e-6
    assert found.force == pytest.approx(0.0665, rel=0.15)


def test_orthotropic_fabric_tells_lateral_from_across():
    scene = replace(COLD, modulus_ratio=1.1)
    along, across = (
        solve_between_plates(scene, Plates(1.1, axis), tolerance=2e-2).force
        for axis in (PlateAxis.LATERAL, PlateAxis.ACROSS)
    )
    assert along != pytest.approx(across, rel=1e-3)


def test_a_loop_that_would_tilt_is_told_of():
    """As a stick between two plates does; turned rigidly, it needs less room."""
    found = solve_between_plates(HOT, Plates(1.6))
    assert found.lowest_eigenvalue > 0 > found.tilt_eigenvalue
    assert not found.upright
    assert _omitted(found, TILT).matters
    assert _room_of_a_tilt(found) < 0


def test_a_loop_on_four_feet_stands():
    found = solve_between_plates(COLD, Plates(0.9))
    assert found.upright
    assert not _omitted(found, TILT).matters
    assert _room_of_a_tilt(found) > 0


def _room_of_a_tilt(found, angle=1e-2):
    """How much more room along x a loop takes that is turned about y."""
    x, _, z = found.shape.edge(200_000).T
    turned = x * np.cos(angle) + z * np.sin(angle)
    return np.ptp(turned) - np.ptp(x)


def test_a_gap_too_small_is_refused():
    with pytest.raises(NotConvergedError, match="not a minimum"):
        solve_between_plates(COLD, Plates(0.6))
    found = solve_between_plates(COLD, Plates(0.6), allow_unreliable=True)
    assert found.lowest_eigenvalue < 0
    with pytest.raises(NotConvergedError, match="wider gap"):
        solve_between_plates(COLD, Plates(0.05))


def test_ellipses_are_refused():
    with pytest.raises(SceneError, match="axis_ratio"):
        solve_between_plates(replace(COLD, axis_ratio=1.5), Plates(1.0))
