"""Far corners of the box of scenes: a minimum, or a clear refusal; never a wrong shape."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solver.checks import writhe
from solver.compact import solve_loop
from solver.disc_basis import disc_basis, transfer
from solver.equilibrium import Kind
from solver.errors import NotConvergedError
from solver.loop_energy import loop_energy
from solver.newton import minimise
from solver.reading import Reading
from solver.scene import LoopScene
from solver.shape import LoopShape
from solver.symmetry import Symmetry
from solver.threshold import critical_beta

ANYTHING = Symmetry(((0, 0), (1, 1), (1, 0), (0, 1)), ((0, 0), (1, 1), (1, 0), (0, 1)))


def _check(scene):
    found = solve_loop(scene, allow_unreliable=True)
    if found.status != "converged":
        with pytest.raises(NotConvergedError, match=r"raise beta|tolerance above"):
            solve_loop(scene)
        return
    assert np.isfinite(found.energy)
    assert np.isfinite(found.shape.edge(16)).all()
    assert found.lowest_eigenvalue > -1e-5 * max(1, scene.axial_stiffness / 1e6)
    assert 0 <= found.shape.height_over_perimeter < 0.3
    assert found.shape.width > 0


@settings(deadline=None, max_examples=40)
@given(
    st.floats(0, 2),
    st.floats(-6, 6),
    st.floats(-0.9, 0.4999),
    st.sampled_from(list(Reading)),
    st.floats(-2, 9),
)
def test_circles(strain, log_beta, poisson, reading, log_stiffness):
    _check(LoopScene(strain, 10**log_beta, poisson, reading, 10**log_stiffness))


@settings(deadline=None, max_examples=12)
@given(
    st.fixed_dictionaries(
        {
            "strain": st.floats(0, 2),
            "beta": st.floats(-6, 6).map(lambda power: 10**power),
            "poisson": st.floats(-0.9, 0.4999),
            "axial_stiffness": st.floats(-2, 9).map(lambda power: 10**power),
            "axis_ratio": st.floats(1, 10),
            "modulus_ratio": st.floats(0.5, 2),
            "natural_curvature": st.floats(0, 2),
        }
    )
)
def test_ellipses_on_any_fabric(numbers):
    _check(LoopScene(**numbers))


@settings(deadline=None, max_examples=25)
@given(
    st.floats(0.01, 0.5),
    st.floats(1.01, 5),
    st.floats(-0.9, 0.49),
    st.sampled_from(list(Reading)),
    st.floats(5, 9),  # a softer wire gives way and lowers the threshold by a percent
)
def test_stiff_wires_up_to_five_times_the_threshold_are_solved(
    strain, excess, poisson, reading, log_stiffness
):
    beta = critical_beta(strain, poisson, reading) / excess
    found = solve_loop(LoopScene(strain, beta, poisson, reading, 10**log_stiffness))
    assert found.kind is Kind.SADDLE


def test_the_limit_of_a_stiff_wire():
    heights = [
        solve_loop(LoopScene(0.3, 0.0145, 0.3, axial_stiffness=k), tolerance=1e-7).shape.height
        for k in (1e3, 1e5, 1e7, 1e9)
    ]
    lack = heights[-1] - np.array(heights[:-1])
    assert lack[:-1] / lack[1:] == pytest.approx(100, rel=0.02)


@pytest.mark.parametrize("excess", [1 + 1e-4, 1 + 1e-3, 1.01])
def test_just_beyond_the_threshold(excess):
    beta = critical_beta(0.3, 0.3, Reading.PUBLISHED) / excess
    found = solve_loop(LoopScene(0.3, beta, 0.3, Reading.PUBLISHED, 1e9))
    assert found.buckled
    assert found.shape.height**2 == pytest.approx(1.011 * (excess - 1), rel=0.02)


def test_a_millionth_beyond_the_threshold():
    """Newton's steps would not leave a first guess that is flat."""
    beta = critical_beta(0.3, 0.3, Reading.PLANE_STRESS) / (1 + 1e-6)
    found = solve_loop(LoopScene(0.3, beta, 0.3, axial_stiffness=1e8))
    assert found.buckled
    assert found.shape.height**2 == pytest.approx(0.96e-6, rel=0.05)


@pytest.mark.parametrize("stiffness", [1e3, 1e6, 1e9])
@pytest.mark.parametrize("excess", [-1e-6, -1e-9, 0.0, 1e-9, 1e-7, 1e-6, 1e-5])
def test_at_the_threshold_itself(excess, stiffness):
    """A stretch of 1/k is the smallest that rounding leaves; below it the loop may be refused."""
    beta = critical_beta(0.3, 0.3, Reading.PUBLISHED) / (1 + excess)
    scene = LoopScene(0.3, beta, 0.3, Reading.PUBLISHED, stiffness)
    found = solve_loop(scene, allow_unreliable=True)
    assert found.shape.height < 0.01
    if found.status != "converged":
        assert stiffness == 1e9
        assert "axial_stiffness" in found.status


def test_random_starts_find_two_minima_of_which_the_saddle_is_lower():
    """Among all shapes, whatever their symmetry: the saddle, or a loop curled through itself.

    The curled one, of writhe ±1, is reached only by passing the wire through itself, and its wire
    would be twisted by a full turn; its fabric is slack.
    """
    scene = LoopScene(0.3, 0.0145, 0.3)
    rng = np.random.default_rng(0)
    saddle, basis = disc_basis(5, "saddle"), disc_basis(5, ANYTHING)
    found = solve_loop(scene)
    flat = solve_loop(LoopScene(0.3, 0.05, 0.3)).shape.coefficients
    energy = loop_energy(scene, basis)
    scale = 0.15 / np.array([unknown[0].function.degree + 1 for unknown in basis.unknowns])
    ends = []
    for _ in range(20):
        start = transfer(saddle, basis) @ flat + scale * rng.normal(size=basis.size)
        ends.append(minimise(energy.derivatives, start, tolerance=1e-5, radius=0.3))
    assert all(end.converged for end in ends)
    saddles = 0
    for end in ends:
        turns = abs(writhe(LoopShape(basis.unknowns, end.unknowns).edge(96)))
        if turns < 0.5:
            saddles += 1
            assert turns == pytest.approx(0, abs=1e-3)
            assert end.value == pytest.approx(0.30933222, abs=1e-7)
        else:
            assert turns == pytest.approx(1, abs=1e-3)
            assert end.value == pytest.approx(0.374067, abs=1e-5)
    assert saddles >= 15
    assert found.energy == pytest.approx(0.30933222, rel=1e-4)


def test_a_neighbour_leads_to_the_same_minimum():
    scene = LoopScene(0.3, 0.0145, 0.3)
    alone = solve_loop(scene, tolerance=1e-6)
    for other in (
        LoopScene(0.33, 0.0145, 0.3),
        LoopScene(0.3, 0.012, 0.4),
        LoopScene(0.1, 0.03, 0.3),
        LoopScene(0.3, 0.0145, 0.3, axis_ratio=1.2),
    ):
        led = solve_loop(scene, tolerance=1e-6, start=solve_loop(other))
        assert led.energy == pytest.approx(alone.energy, rel=1e-10)
        assert led.shape.height == pytest.approx(alone.shape.height, rel=1e-7)
    near = solve_loop(scene, start=solve_loop(LoopScene(0.31, 0.0145, 0.3)))
    assert near.steps < solve_loop(scene).steps


def test_natural_curvature_raises_the_saddle():
    heights = [
        solve_loop(LoopScene(0.3, 0.0145, 0.3, natural_curvature=k0)).shape.height
        for k0 in (0.0, 0.5, 1.0)
    ]
    assert np.all(np.diff(heights) > 0)


def test_a_wire_of_too_much_natural_curvature_would_wriggle():
    with pytest.raises(NotConvergedError, match="resistance to twist"):
        solve_loop(LoopScene(0.3, 0.0145, 0.3, natural_curvature=4.0))
