import numpy as np
import pytest

from solver.strip.omissions import left_out
from solver.strip.scene import StripScene
from solver.strip.snap import solve_strip
from solver.strip.state import Side

SCENE = StripScene(0.12, 0.115, 0.02, 0.38e-3)


@pytest.fixture(scope="module")
def terms():
    found = solve_strip(SCENE)
    return found.unloaded[Side.UP], {term.term: term for term in found.omitted}


def test_width(terms):
    state, left = terms
    largest = np.abs(state.curvatures_per_m).max()
    assert left["bending across the width"].value == pytest.approx(0.02**2 * largest / 0.38e-3)
    assert left["stiffness of a wide strip"].value == pytest.approx(1 / (1 - 0.37**2) - 1)
    assert left["twist and bending sideways"].value == pytest.approx((0.38 / 20) ** 2)


def test_stretch(terms):
    """P L/(E A) over δ tends to π² t²/(12 L²) / δ for a strip that is little bent."""
    value = terms[1]["stretch of the beam"].value
    assert value == pytest.approx(
        np.pi**2 * (0.38e-3 / 0.12) ** 2 / 12 / SCENE.shortening, rel=0.05
    )


def test_weight(terms):
    """The weight of 1.09 g over a mean height of 2/π of the greatest one."""
    state, left = terms
    work = 1200 * 0.02 * 0.38e-3 * 0.12 * 9.80665 * 2 / np.pi * state.height_m
    assert left["weight"].value == pytest.approx(work / state.bending_J, rel=0.03)


def test_strain(terms):
    largest = np.abs(terms[0].curvatures_per_m).max()
    assert terms[1]["plastic bending"].value == pytest.approx(0.19e-3 * largest)


def test_a_narrow_strip_bends_as_a_beam(terms):
    narrow = StripScene(0.12, 0.115, 0.002, 0.38e-3)
    left = {term.term: term.matters for term in left_out(narrow, terms[0])}
    assert not left["bending across the width"]
    assert not left["stiffness of a wide strip"]
    assert left["twist and bending sideways"]
