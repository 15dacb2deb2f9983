"""Good specifications: defaults, conversions, and what is written and read back."""

import tomllib
from dataclasses import asdict
from pathlib import Path

import pytest
from annotated_types import Ge, Gt, Le, Lt
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from patterns.machine import Machine
from patterns.path import Line
from patterns.sewn_run import APPROACH_MM
from patterns.stitching import ROUNDING_MM, Stitching
from patterns.tangent_switch import grid_circuit
from sesame_cad.specification import (
    Specification,
    json_schema,
    load_specification,
    specification_from,
)
from sesame_cad.specification.consistency import needed_hoop_mm
from sesame_cad.specification.specification import sections

EXAMPLES = Path(__file__).parents[2] / "examples"
LARGE = {
    "wire": {"diameter_mm": 0.5},
    "layout": {"rows": 4, "columns": 4, "loop_diameter_mm": 50},
}
BOUND_TO_OTHERS = {
    "loop_diameter_mm",
    "hoop_width_mm",
    "hoop_height_mm",
    "hoop_rim_mm",
    "preview_thickness_mm",
}


def numbers(field):
    """Draw any number that a field allows."""
    low, high, options = 0.0, 0.0, {}
    for limit in field.metadata:
        match limit:
            case Gt(gt=low):
                options["exclude_min"] = True
            case Lt(lt=high):
                options["exclude_max"] = True
            case Ge(ge=low):
                options["exclude_min"] = False
            case Le(le=high):
                options["exclude_max"] = False
    return st.floats(low, high, **options)


@st.composite
def specifications(draw):
    """Draw specifications in which every number that is free takes any value it may."""
    data = {"name": draw(st.from_regex(r"[A-Za-z0-9][A-Za-z0-9._-]{0,63}", fullmatch=True))}
    for name, section in sections().items():
        if name in {"layout", "stitching", "beam", "sleeve"}:
            continue
        data[name] = {
            key: draw(numbers(field))
            for key, field in section.model_fields.items()
            if field.annotation is float and key not in BOUND_TO_OTHERS
        }
    data["wire"]["diameter_mm"] = draw(st.floats(0.2, 0.5))
    data["outline"]["margin_mm"] = draw(st.floats(0.1, 5))  # a wider rim wants a larger hoop
    data["layout"] = LARGE["layout"]
    data["machine"]["name"] = draw(st.text(min_size=1, max_size=80).filter(str.isprintable))
    data["output"]["formats"] = draw(st.lists(st.sampled_from(["dst", "exp", "u01"])))
    data["output"]["pictures"] = draw(st.booleans())
    if draw(st.booleans()):
        data["output"]["preview_thickness_mm"] = draw(st.floats(0.001, 0.2))
    return specification_from(data, "unused")


@given(specifications())
@settings(deadline=None, max_examples=60)
def test_what_is_written_reads_back_equal(specification):
    text = specification.to_toml()
    again = specification_from(tomllib.loads(text), "another")
    assert again == specification
    assert again.to_toml() == text


def test_what_is_written_holds_every_key():
    written = tomllib.loads(specification_from(LARGE, "large").to_toml())
    for name, section in sections().items():
        left_out = {"preview_thickness_mm", "current_A"} & set(written[name])
        assert left_out == ({"current_A"} if name == "supply" else set())
        follows = {
            "wire": {"current_A"},
            "actuation": {"convection_W_m2K"},
            "output": {"preview_thickness_mm"},
        }.get(name, set())
        assert set(written[name]) == set(section.model_fields) - follows
    assert "# preview_thickness_mm is left to its default" in (
        specification_from(LARGE, "large").to_toml().splitlines()
    )


def test_defaults_are_those_of_table_1_and_of_the_geometry():
    specification = specification_from(LARGE, "large")
    assert specification.fabric.model_dump() == {
        "prestrain": 0.3,
        "thickness_mm": 0.27,
        "modulus_kPa": 700,
        "poisson": 0.45,
        "areal_density_g_m2": 190,
    }
    assert (specification.wire.modulus_cold_GPa, specification.wire.modulus_hot_GPa) == (28, 75)
    assert specification.model.reading == "plane-stress"
    assert specification.patterns_stitching() == Stitching()
    assert specification.patterns_machine() == Machine(406, 330, 0.75)
    assert specification.output.formats == ("dst",)


def test_conversions_carry_every_value():
    words = {"cover_underlay": "edge", "stripes": "rows", "stripe_passes": 2, "ties": "contacts"}
    plain = {"cover_overlap_mm": 0.2} | {
        key: value * 1.1
        for key, value in asdict(Stitching()).items()
        if key not in {*words, "cover_overlap_mm"}
    }
    stitching = {key: (plain | words)[key] for key in asdict(Stitching())}
    machine = {
        "hoop_width_mm": 420.0,
        "hoop_height_mm": 410.0,
        "needle_diameter_mm": 0.9,
        "longest_stitch_mm": 11.0,
        "shortest_stitch_mm": 0.4,
        "jumps_per_trim": 5,
        "hoop_rim_mm": 1.0,
        "couching": "centreline",
        "swing_mm": 3.0,
        "hand_guided": True,
    }
    specification = specification_from({**LARGE, "stitching": stitching, "machine": machine}, "x")
    assert asdict(specification.patterns_stitching()) == stitching
    assert asdict(specification.patterns_machine()) == machine


def test_the_least_needle_margin_outlasts_rounding():
    limits = sections()["stitching"].model_fields["needle_margin_mm"].metadata
    assert any(isinstance(limit, Ge) and limit.ge > ROUNDING_MM for limit in limits)


@pytest.mark.parametrize(
    ("stem", "rows", "loop", "wire", "transition"),
    [("large-array", 4, 50, 0.5, 40), ("small-array", 6, 25, 0.3, 60)],
)
def test_examples_are_table_1(stem, rows, loop, wire, transition):
    specification = load_specification(EXAMPLES / f"{stem}.toml")
    assert specification.name == stem
    assert specification.layout.rows == specification.layout.columns == rows
    assert specification.layout.loop_diameter_mm == loop
    assert specification.wire.diameter_mm == wire
    assert specification.wire.transition_C == transition
    assert specification.fabric.prestrain == 0.3


def test_the_files_stem_is_the_name_unless_it_has_one(tmp_path):
    path = tmp_path / "wing-2.toml"
    text = specification_from(LARGE, "x").to_toml()
    path.write_text(text.replace('name = "x"\n', "", 1))
    assert load_specification(path).name == "wing-2"
    path.write_text(text)
    assert load_specification(str(path)).name == "x"


def test_overrides_replace_and_add(tmp_path):
    path = tmp_path / "a.toml"
    path.write_text(specification_from(LARGE, "x").to_toml())
    overrides = {"name": "y", "fabric.prestrain": 0.2, "layout.rows": 3, "output.formats": ["u01"]}
    specification = load_specification(path, overrides)
    assert specification.name == "y"
    assert specification.fabric.prestrain == 0.2
    assert specification.layout.rows == 3
    assert specification.output.formats == ("dst", "u01")


def test_overrides_may_give_a_section_that_the_file_lacks():
    specification = load_specification(EXAMPLES / "large-array.toml", {"model.tolerance": 1e-3})
    assert specification.model.tolerance == 1e-3


def test_whole_numbers_do_for_others_and_hot_may_be_softer_than_cold():
    wire = {"diameter_mm": 1, "modulus_hot_GPa": 20}
    assert specification_from({**LARGE, "wire": wire}, "x").wire.diameter_mm == 1.0


def test_a_specification_does_not_change():
    specification = specification_from(LARGE, "x")
    with pytest.raises(ValidationError):
        specification.name = "y"
    with pytest.raises(ValidationError):
        specification.fabric.prestrain = 0.1


def test_made_directly_it_is_checked_too():
    layout = {"rows": 40, "columns": 4, "loop_diameter_mm": 50}
    with pytest.raises(ValidationError, match="hoop_height_mm = 330: must be at least"):
        Specification.model_validate({"name": "x", **LARGE, "layout": layout})


@pytest.mark.parametrize(
    ("wire_mm", "fabric_mm", "given_mm", "expected_mm"),
    [(0.5, 0.27, None, 0.27), (0.3, 0.27, None, 0.24), (0.3, 0.27, 0.3, 0.3)],
)
def test_the_preview_is_as_thick_as_the_fabric_but_thinner_than_the_wire(
    wire_mm, fabric_mm, given_mm, expected_mm
):
    data = {**LARGE, "wire": {"diameter_mm": wire_mm}, "fabric": {"thickness_mm": fabric_mm}}
    if given_mm is not None:
        data["output"] = {"preview_thickness_mm": given_mm}
    assert specification_from(data, "x").preview_thickness_mm == pytest.approx(expected_mm)


@pytest.mark.parametrize(("wire_mm", "loop_mm"), [(0.3, 15), (0.1, 5), (0.7, 35), (0.55, 27.5)])
def test_a_loop_of_just_the_smallest_bend_is_accepted(wire_mm, loop_mm):
    layout = {"rows": 1, "columns": 1, "loop_diameter_mm": loop_mm}
    specification_from({"wire": {"diameter_mm": wire_mm}, "layout": layout}, "x")


@given(
    st.integers(1, 5), st.integers(1, 5), st.floats(15, 60), st.floats(15, 200), st.floats(0.1, 0.3)
)
@settings(deadline=None, max_examples=40)
def test_the_hoop_is_as_large_as_loops_tails_and_marks(rows, columns, loop, tail, wire):
    circuit = grid_circuit(rows, columns, loop, tail)
    points = [stage.polyline(1e-4) for stage in circuit.stages]
    reach = (
        max(abs(half[:, 0]).max() for half in points),
        max(abs(half[:, 1]).max() for half in points),
    )
    parts = {
        "wire": {"diameter_mm": wire},
        "layout": {"rows": rows, "columns": columns, "loop_diameter_mm": loop},
        "stitching": {"tail_length_mm": tail},
        "machine": {"hoop_width_mm": 5000, "hoop_height_mm": 5000},
    }
    specification = specification_from(parts, "x")
    needed = needed_hoop_mm(
        specification.wire,
        specification.layout,
        specification.stitching,
        specification.outline,
    )
    rim = wire / 2 + specification.outline.margin_mm
    around = rim + specification.stitching.mark_gap_mm + specification.stitching.mark_size_mm
    around += APPROACH_MM
    assert needed == pytest.approx([2 * (half + around) for half in reach], abs=1e-3)
    assert isinstance(circuit.wire.pieces[0], Line)


def test_the_schema_describes_every_key_with_default_or_requires_it():
    schema = json_schema()
    assert schema["title"]
    parts = {**schema["$defs"], "": schema}
    for part in parts.values():
        for key, described in part["properties"].items():
            assert described["description"]
            assert "default" in described or key in part.get("required", ()) or key == "name"
    assert schema["required"] == ["wire", "layout"]
    assert "name" in schema["properties"]


UNITS = {
    "mm": "mm",
    "kPa": "kPa",
    "GPa": "GPa",
    "C": "°C",
    "uohm_cm": "microohm cm",
    "g_cm3": "g/cm3",
    "g_m2": "g/m2",
    "V": "in V",
    "A": "in A",
    "deg": "degrees",
    "spm": "stitches per minute",
    "s": " in s",
    "W_m2K": "W/m²K",
    "J_gK": "J/gK",
    "J_g": "J/g",
    "load_g": "mass in g",
}
UNITLESS = ("no unit", "a count", "a word", "words", "a text", "true or false")


def test_every_description_names_the_unit():
    for section in sections().values():
        for key, field in section.model_fields.items():
            unit = next(
                (text for end, text in UNITS.items() if f"_{key}".endswith(f"_{end}")), None
            )
            names = (*UNITLESS, "in mm") if unit is None else (unit,)
            assert any(words in field.description for words in names), key


def test_the_schema_states_limits_choices_and_no_further_keys():
    definitions = json_schema()["$defs"]
    poisson = definitions["FabricSection"]["properties"]["poisson"]
    assert (poisson["exclusiveMinimum"], poisson["exclusiveMaximum"]) == (-1, 0.5)
    reading = definitions["ModelSection"]["properties"]["reading"]
    assert reading["enum"] == ["plane-stress", "published"]
    assert all(part["additionalProperties"] is False for part in definitions.values())
