import json
from dataclasses import replace
from pathlib import Path

import pytest

from solver.materials import LoopMaterials

LARGE = str(Path(__file__).parents[2] / "examples" / "large-array.toml")


@pytest.fixture
def scale(run_command):
    def run(*arguments):
        code, out, err = run_command(["scale", "--like", LARGE, *arguments, "--json"])
        assert code == 0, err
        return json.loads(out)

    return run


def test_the_paper_s_rule(scale):
    data = scale("--wire-diameter", "0.3mm")
    assert data["loop_diameter_mm"] == pytest.approx(50 * 0.6 ** (4 / 3), rel=1e-12)
    assert data["loop_diameter_mm"] == pytest.approx(25.30, abs=5e-3)
    size = data["loop_diameter_mm"] / 50
    ratios = data["ratios"]
    for key in ("height_mm", "pitch_mm", "smallest_bend_radius_mm", "force_unit_N"):
        assert ratios[key] == pytest.approx(size)
    assert ratios["energy_unit_mJ"] == pytest.approx(size**2)
    assert ratios["resistance_cold_ohm"] == pytest.approx(size / 0.6**2)
    assert data["beta_hot"] == pytest.approx(data["like_beta_hot"])


def test_the_same_wire_is_the_design_itself(scale):
    data = scale("--wire-diameter", "0.5mm")
    assert data["asked"] == pytest.approx(data["like"])


def test_other_materials(scale):
    data = scale("--wire-diameter", "0.5mm", "--fabric-modulus", "5600kPa")
    assert data["loop_diameter_mm"] == pytest.approx(25)
    assert data["ratios"]["force_unit_N"] == pytest.approx(4)
    twice = scale("--wire-diameter", "0.5mm", "--wire-modulus-hot", "150GPa")
    assert twice["loop_diameter_mm"] == pytest.approx(50)
    assert twice["beta_hot"] == pytest.approx(2 * twice["like_beta_hot"])


def test_every_stock_wire_has_the_same_beta(scale):
    data = scale("--wire-diameter", "0.3mm", "--fabric-thickness", "0.4mm")
    assert len(data["stock"]) == 7
    for loop in data["stock"]:
        own = LoopMaterials(
            700e3,
            0.4e-3,
            28e9,
            loop["wire_diameter_mm"] / 1e3,
            loop["loop_diameter_mm"] / 2e3,
        )
        assert own.beta == pytest.approx(data["beta"])


def test_radius_of_its_own_beta():
    own = LoopMaterials(700e3, 0.27e-3, 28e9, 0.5e-3, 25e-3)
    assert own.radius_of_beta(own.beta) == pytest.approx(25e-3)
    assert replace(own, loop_radius_m=1).radius_of_beta(own.beta) == pytest.approx(25e-3)


def test_a_person_is_told_what_does_not_stay(run_command):
    code, out, _ = run_command(["scale", "--like", LARGE, "--wire-diameter", "0.3mm"])
    assert code == 0
    assert "loop diameter of equal β: 25.30 mm" in out
    assert "not the same: forces × 0.506" in out


@pytest.mark.parametrize(
    ("arguments", "fault"),
    [
        (["--wire-diameter", "0.3"], "--wire-diameter: '0.3' has no unit: write 0.3mm"),
        (["--wire-diameter", "0mm"], "--wire-diameter: '0mm': must be greater than 0"),
    ],
)
def test_bad_quantities(arguments, fault, faults_of_command):
    (said,) = faults_of_command(["scale", "--like", LARGE, *arguments])
    assert said.startswith(f"error: {fault}")
