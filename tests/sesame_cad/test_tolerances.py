import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from sesame_cad.errors import InputError
from sesame_cad.loop_response import loop_design, respond
from sesame_cad.specification import load_specification
from sesame_cad.tolerances import HeightBand, height_band, measured_array, tolerances_data

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(scope="module")
def large():
    return load_specification(EXAMPLES / "large-array.toml")


@pytest.mark.parametrize(
    "key",
    [
        "loop_diameter_mm",
        "wire_diameter_mm",
        "prestrain",
        "fabric_modulus_kPa",
        "fabric_thickness_mm",
        "poisson",
        "wire_modulus_GPa",
    ],
)
def test_derivatives_by_materials_as_differences(large, key):
    design = loop_design(large, "cold")
    told = respond(design, 1e-7)
    value = getattr(design, key)
    step = 1e-4 * value
    above, below = (respond(replace(design, **{key: value + s * step}), 1e-7) for s in (1, -1))
    for name in ("height", "pitch"):
        rise = getattr(above, f"{name}_mm") - getattr(below, f"{name}_mm")
        expected = rise / (2 * step)
        assert getattr(told, f"{name}_by")[key] == pytest.approx(expected, rel=1e-4)


def test_scaling_all_lengths_scales_the_height(large):
    """Euler's theorem: h is of degree 1 in all lengths together."""
    design = loop_design(large, "cold")
    told = respond(design, 1e-7)
    lengths = ("loop_diameter_mm", "wire_diameter_mm", "fabric_thickness_mm")
    total = sum(getattr(design, key) * told.height_by[key] for key in lengths)
    assert total == pytest.approx(told.height_mm, rel=1e-9)


def test_small_tolerances_are_as_sampled(large, monkeypatch):
    monkeypatch.setattr(
        "sesame_cad.tolerances.half_widths",
        lambda design: {"prestrain": 1e-3, "wire_diameter_mm": 1e-3},
    )
    band = height_band(loop_design(large, "cold"), "cold", 1e-6)
    # what is not linear is of second order in them
    np.testing.assert_allclose(band.sampled, band.first_order, atol=0.02 * band.worst)
    assert band.sampled[3] - band.height == pytest.approx(band.worst, rel=0.05)


def test_the_paper_s_arrays(large):
    data = tolerances_data(large)
    assert data["cold"]["height"] == pytest.approx(0.1399, abs=1e-4)
    assert data["measured"]["array"] == "large array"
    assert data["measured"]["lies"].startswith("outside by 0.000")
    small = tolerances_data(load_specification(EXAMPLES / "small-array.toml"))
    assert small["measured"]["lies"] == "inside"
    assert (
        measured_array(load_specification(EXAMPLES / "large-array.toml", {"wire.diameter_mm": 0.4}))
        is None
    )


def test_verdicts():
    band = HeightBand("cold", 0.14, (), 0, 0, (0.13, 0.131, 0.148, 0.149), (0,) * 4, 1, 0)
    assert band.verdict(0.13) == "inside"
    assert band.verdict(0.15) == "outside by 0.0010, which rounding to two digits may make up"
    assert band.verdict(0.12) == "outside by 0.0100"


def test_design_prints_them(run_command, tmp_path):
    spec = str(EXAMPLES / "large-array.toml")
    target = tmp_path / "large"
    code, out, err = run_command(["design", spec, "--tolerances", "-o", str(target)])
    assert code == 0, err
    assert "prestrain ± 0.02" in out
    assert "measured on the paper's large array, cold: 0.15, outside by" in out
    assert "tolerances" not in json.loads((target / "design.json").read_text())


def test_tolerances_of_coupled_shapes_are_refused(faults_of_command, tmp_path):
    spec = str(EXAMPLES / "hexagonal.toml")
    (fault,) = faults_of_command(["design", spec, "--tolerances", "-o", str(tmp_path / "out")])
    assert "tolerances are reckoned for equal loops" in fault
    assert not (tmp_path / "out").exists()


def test_a_tolerance_larger_than_its_number(large):
    design = replace(loop_design(large, "cold"), wire_diameter_mm=0.02)
    with pytest.raises(InputError, match="not greater than its tolerance"):
        height_band(design, "cold")
