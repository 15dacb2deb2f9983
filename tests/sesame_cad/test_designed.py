"""The Python interface: the same design as the command makes, as values."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

import sesame_cad
from sesame_cad.verification import verify

EXAMPLE = Path(__file__).parents[2] / "examples" / "large-array.toml"
SMALL = {"layout.rows": 1, "layout.columns": 2}


@pytest.fixture(scope="module")
def made():
    return sesame_cad.design(EXAMPLE, SMALL)


def test_the_values_are_those_of_the_file(made, tmp_path):
    folder = tmp_path / "out"
    data = made.write(folder)
    read = json.loads((folder / "design.json").read_text())
    assert data == read
    assert read["cold"]["height_mm"] == made.cold.height_mm > made.hot.height_mm > 0
    assert {**made.data, "files": None} == {**read, "files": None}
    assert verify(folder) == ()


def test_a_mapping_makes_the_same_as_a_file(made):
    layout = {"rows": 4, "columns": 4, "loop_diameter_mm": 50}
    wire = {"diameter_mm": 0.5, "transition_C": 40, "current_A": 1.3}
    mapping = {"name": "large-array", "layout": layout, "wire": wire}
    assert sesame_cad.design(mapping, SMALL).spec == made.spec


def test_a_fault_is_an_exception_with_its_lines():
    with pytest.raises(sesame_cad.InputError) as caught:
        sesame_cad.design(EXAMPLE, {"layout.rows": 0, "wire.diameter_mm": "thin"})
    keys = [
        key
        for line in caught.value.faults
        for key in ("layout.rows", "wire.diameter_mm")
        if key in line
    ]
    assert sorted(keys) == ["layout.rows", "wire.diameter_mm"]


def test_a_design_without_a_shape_has_none():
    made = sesame_cad.design(EXAMPLE, {**SMALL, "layout.shape": "none"})
    assert made.cold is None
    assert made.hot is None
    assert "large-array" in made._repr_html_()


def test_a_notebook_shows_numbers_and_pictures(made):
    page = made._repr_html_()
    assert f"{made.cold.height_mm:.2f} mm high" in page
    assert page.count("data:image/png;base64,") == 2


def test_the_package_itself_loads_nothing_heavy():
    code = "import sesame_cad, sys; print('numpy' in sys.modules, 'pydantic' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["False", "False"]


def test_a_name_that_is_not_there_is_told():
    with pytest.raises(AttributeError, match="has no attribute 'desing'"):
        sesame_cad.desing  # noqa: B018
    assert set(sesame_cad.__all__) <= set(dir(sesame_cad))
