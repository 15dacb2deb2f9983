"""Distances against brute force, and crossings that are plain to see."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize

from solver.mesh.segments import (
    on_both_sides,
    pierces,
    segment_distance,
    segment_triangle_distance,
)

SEEDS = st.integers(0, 10**6)


def _nearest(distance, size):
    """Smallest distance by descent from several points of a box, the sum of whose sides is < 1."""
    starts = np.random.default_rng(0).dirichlet(np.ones(size + 1), size=8)[:, :size]
    found = [
        minimize(lambda p: distance(p) ** 2, start, bounds=[(0, 1)] * size).fun for start in starts
    ]
    return min(found) ** 0.5


@settings(deadline=None, max_examples=25)
@given(SEEDS)
def test_segment_distance_is_the_smallest(seed):
    p, p_end, q, q_end = np.random.default_rng(seed).normal(size=(4, 3))
    expected = _nearest(
        lambda t: np.linalg.norm(p + t[0] * (p_end - p) - q - t[1] * (q_end - q)), 2
    )
    found = segment_distance(p[None], p_end[None], q[None], q_end[None])[0]
    assert found == pytest.approx(expected, abs=1e-5)


def test_parallel_segments():
    x = np.array([1.0, 0, 0])
    start = np.zeros((3, 3))
    other = np.array([[0.5, 0, 0.2], [1.5, 0, 0], [-3.0, 0.3, 0]])
    lengths = np.array([[1.0], [1.0], [2.0]])
    found = segment_distance(start, start + x, other, other + lengths * x)
    assert found == pytest.approx([0.2, 0.5, np.hypot(1, 0.3)])


@settings(deadline=None, max_examples=25)
@given(SEEDS)
def test_distance_of_segment_and_triangle(seed):
    rng = np.random.default_rng(seed)
    ends, triangle = rng.normal(size=(2, 3)), rng.normal(size=(3, 3))
    found = segment_triangle_distance(ends[None, 0], ends[None, 1], triangle[None])[0]
    t, u, v = np.meshgrid(*[np.linspace(0, 1, 41)] * 3)
    points = ends[0] + t[..., None] * (ends[1] - ends[0])
    sheet = triangle[0] + (u[..., None] * (triangle[1] - triangle[0]))
    sheet = sheet + ((1 - u) * v)[..., None] * (triangle[2] - triangle[0])
    sampled = np.linalg.norm(points - sheet, axis=-1).min()
    assert found <= sampled + 1e-12
    assert found >= sampled - 0.25  # as far as a sample may lie from the nearest point
    through = pierces(ends[None, 0], ends[None, 1], triangle[None])[0]
    assert through == (found == 0)


def test_crossing_is_seen_and_touching_is_none():
    triangle = np.array([[[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]] * 5)
    start = np.array([[0.2, 0.2, 1], [0.2, 0.2, 1], [0.8, 0.8, 1], [0.2, 0.2, 0], [0, 0, 1.0]])
    end = np.array([[0.2, 0.2, -1], [0.2, 0.2, 0.1], [0.8, 0.8, -1], [0.7, 0.1, 0], [0, 0, -1.0]])
    assert pierces(start, end, triangle).tolist() == [True, False, False, False, True]
    assert on_both_sides(start, end, triangle).tolist() == [True, False, True, False, True]
