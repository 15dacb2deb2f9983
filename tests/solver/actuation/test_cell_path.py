"""The free cell from cold to hot and back, and under load."""

from dataclasses import replace

import numpy as np
import pytest

from solver.actuation.cell_path import HeatedCell, cell_path
from solver.actuation.lifting import pressed, stands_at
from solver.actuation.load_table import height_history, load_table
from solver.circle import stays_flat
from solver.compact import solve_loop
from solver.errors import NotConvergedError, SceneError
from solver.held import solve_between_plates
from solver.plates import PlateAxis, Plates
from solver.scene import LoopScene
from solver.threshold import critical_beta

COLD = LoopScene(0.3, 0.01454, 0.3, axial_stiffness=1163.0)
CELL = HeatedCell(COLD, 75 / 28)
STIFF = HeatedCell(COLD, 4.0)
SOFT = HeatedCell(replace(COLD, beta=0.05), 0.25)


@pytest.fixture(scope="module")
def path():
    return cell_path(CELL)


@pytest.fixture(scope="module")
def table(path):
    return load_table(CELL, path.response)


def test_the_way_back_is_the_way_there(path):
    assert len(path.heating) == len(path.cooling) == 25
    for up, down in zip(path.heating, path.cooling, strict=True):
        assert up.scene == down.scene
        assert down.shape.height == pytest.approx(up.shape.height, rel=2e-4)
    assert path.events == ()


def test_states_are_those_of_single_solves(path):
    alone = solve_loop(CELL.scene(1.0))
    assert path.heating[-1].shape.height == pytest.approx(alone.shape.height, rel=1e-4)
    assert path.cooling[0].energy == pytest.approx(solve_loop(COLD).energy, rel=1e-6)


@pytest.mark.parametrize("cell", [CELL, STIFF, SOFT])
def test_interpolation_between_the_states(cell):
    response = cell_path(cell).response
    places = np.array([0.013, 0.2, 0.235, 0.4, 0.59, 0.77])
    exact = [solve_loop(cell.scene(float(place)), tolerance=1e-5) for place in places]
    heights = [one.shape.height for one in exact]
    assert response.height(places) == pytest.approx(heights, abs=1e-4)
    assert response.width(places) == pytest.approx([one.shape.width for one in exact], abs=1e-4)
    assert response.energy(places) == pytest.approx([one.energy for one in exact], abs=1e-4)


@pytest.mark.parametrize(
    ("cell", "kinds"),
    [
        (STIFF, [("turns flat", "heating"), ("rises", "cooling")]),
        (SOFT, [("rises", "heating"), ("turns flat", "cooling")]),
    ],
)
def test_the_fraction_at_which_it_turns_flat_is_that_of_the_threshold(cell, kinds):
    """The exact threshold is that of an inextensible wire; this one is shorter by its pressure."""
    found = cell_path(cell)
    assert [(event.kind, event.way) for event in found.events] == kinds
    at = cell.scene(found.events[0].fraction)
    assert at.beta == pytest.approx(critical_beta(0.3, 0.3, COLD.reading), rel=6e-3)
    shares = found.events[0].fraction + np.array([-1e-3, 1e-3])
    assert sorted(stays_flat(cell.scene(float(share))) for share in shares) == [False, True]


def test_height_rises_from_flat_as_a_square_root():
    response, turning = cell_path(STIFF).response, STIFF.flat_from
    near, nearer = (float(response.height(np.array([turning - d]))[0]) for d in (0.02, 0.005))
    assert near / nearer == pytest.approx(2.0, rel=0.02)
    assert float(response.height(np.array([turning + 1e-6]))[0]) == 0


def test_slab_force_by_contact_is_that_by_energy(table):
    """To 1 % at every fraction, by differences of the energy."""
    for fraction in (0.0, 0.4, 1.0):
        free = float(table.response.height(np.array([fraction]))[0])
        height, step = 0.8 * free, 2e-3 * free
        scene = CELL.scene(fraction)
        found = pressed(scene, height, tolerance=1e-3)
        energies = [
            solve_between_plates(
                scene, Plates(height + d, PlateAxis.HEIGHT), tolerance=1e-3, start=found
            ).energy
            for d in (-step, step)
        ]
        by_energy = (energies[0] - energies[1]) / (2 * step)
        by_contact = sum(contact.force for contact in found.contacts if contact.upper)
        assert by_contact == pytest.approx(by_energy, rel=0.01)
        assert table.curve(fraction)[1][200] > 0


@pytest.mark.parametrize("fraction", [0.0, 0.33, 1.0])
@pytest.mark.parametrize("share", [0.3, 0.9])
def test_heights_of_the_table_are_those_of_a_solve(table, fraction, share):
    load = share * table.largest_load(fraction)
    free = float(table.response.height(np.array([fraction]))[0])
    found = stands_at(CELL.scene(fraction), free, load)
    assert found.force == pytest.approx(load, rel=2e-3)
    assert table.height(fraction, load) == pytest.approx(found.height, rel=2e-3)


def test_heights_fall_with_load_down_to_the_one_that_flattens(table):
    largest = table.largest_load(0.2)
    loads = np.linspace(0.0, largest * (1 - 1e-9), 12)
    heights = [table.height(0.2, float(load)) for load in loads]
    assert np.all(np.diff(heights) < 0)
    assert heights[-1] > 0.5 * heights[0]
    assert table.height(0.2, 1.001 * largest) == 0
    assert table.height(0.2, float("inf")) == 0
    with pytest.raises(NotConvergedError, match="flattens the cell"):
        stands_at(CELL.scene(0.2), heights[0], 1.02 * largest)
    with pytest.raises(SceneError, match="load"):
        stands_at(CELL.scene(0.2), heights[0], 0.0)


def test_a_flattened_cell_stays_flat_when_it_cools(table):
    there = np.linspace(0.0, 1.0, 41)
    fractions = np.concatenate([there, there[::-1]])
    load = 0.5 * (table.largest_load(0.0) + table.largest_load(1.0))
    heights, place = height_history(table, fractions, load)
    snap = table.snaps_at(0.0, 1.0, load)
    assert fractions[place - 1] <= snap <= fractions[place]
    assert np.all(heights[:place] > 0)
    assert np.all(heights[place:] == 0)
    light, none = height_history(table, fractions, 0.5 * table.largest_load(1.0))
    assert none is None
    assert light == pytest.approx(light[::-1])
    assert table.snaps_at(0.0, 1.0, 0.5 * table.largest_load(1.0)) is None
    assert table.snaps_at(1.0, 0.0, load) == 1.0


def test_a_cell_that_is_flat_when_hot_carries_nothing_there():
    found = cell_path(STIFF, states=9)
    table = load_table(STIFF, found.response, count=3)
    assert table.largest_load(1.0) == 0
    assert table.height(0.9, 0.0) == 0
    assert table.largest_load(0.0) == pytest.approx(0.181, rel=0.01)
    always = HeatedCell(replace(COLD, beta=0.05), 2.0)
    assert load_table(always, cell_path(always, states=3).response).largest_load(0.5) == 0


def test_ellipses_and_ratios_out_of_range_are_refused():
    with pytest.raises(SceneError, match="modulus_ratio"):
        HeatedCell(COLD, 0.0)
    with pytest.raises(SceneError, match="circle"):
        HeatedCell(replace(COLD, axis_ratio=1.5), 2.0)
