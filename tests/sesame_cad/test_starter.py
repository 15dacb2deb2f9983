"""The starter file explains every key, loads, and stays right when its settings are taken in."""

import re
import tomllib

import pytest

from sesame_cad.errors import InputError
from sesame_cad.specification import load_specification, specification_from
from sesame_cad.specification.specification import sections
from sesame_cad.starter import starter_toml

LARGE = {
    "wire": {"diameter_mm": 0.5},
    "layout": {"rows": 4, "columns": 4, "loop_diameter_mm": 50},
}


def uncommented(text):
    return re.sub(r"(?m)^#(?=\w+ =)", "", text)


def test_it_loads_as_the_large_array(tmp_path):
    path = tmp_path / "anything.toml"
    path.write_text(starter_toml("mine"))
    assert load_specification(path) == specification_from(LARGE, "mine")


def test_the_settings_behind_a_hash_are_the_defaults():
    data = tomllib.loads(uncommented(starter_toml("mine")))
    preview = {"preview_thickness_mm": data["output"].pop("preview_thickness_mm")}
    current = data["wire"].pop("current_A")
    convection = data["actuation"].pop("convection_W_m2K")
    specification = specification_from(data, "x")
    assert convection == specification.convection_W_m2K
    assert specification == specification_from(LARGE, "mine")
    assert current == specification.wire.design_current_A
    assert preview["preview_thickness_mm"] == specification.preview_thickness_mm


def test_every_key_stands_there_once_below_its_explanation():
    text = starter_toml("mine")
    data = tomllib.loads(uncommented(text))
    for name, section in sections().items():
        assert set(data[name]) == set(section.model_fields)
        for key, field in section.model_fields.items():
            comment = re.search(rf"((?:# .*\n)+)#?{key} =", text.partition(f"[{name}]")[2])[1]
            words = " ".join(line.removeprefix("# ") for line in comment.splitlines())
            assert field.description[1:] in words
            assert ". Must be " in words


def test_limits_stand_in_the_comments():
    text = starter_toml("mine")
    assert "# The fabric's Poisson's ratio (no unit). Must be a number greater than -1" in text
    assert '"plane-stress", "published"' in text


def test_only_what_has_no_default_is_set():
    lines = starter_toml("mine").splitlines()
    keys = [line.split(" = ")[0] for line in lines if re.match(r"\w+ =", line)]
    assert keys == ["name", "diameter_mm", "rows", "columns", "loop_diameter_mm"]


def test_lines_are_short_and_the_text_always_the_same():
    assert max(map(len, starter_toml("mine").splitlines())) <= 100
    assert starter_toml("mine") == starter_toml("mine")


def test_a_name_that_will_not_do():
    with pytest.raises(InputError, match='starter file: name = "a b": must be 1 to 64'):
        starter_toml("a b")
