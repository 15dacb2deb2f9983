"""Each bad specification gives exactly its faults, one line each, with key, value and limits."""

import re

import pytest

from sesame_cad.errors import InputError
from sesame_cad.specification import specification_from

GOOD = """
[wire]
diameter_mm = 0.5
[layout]
rows = 4
columns = 4
loop_diameter_mm = 50
"""


def with_line(section: str, line: str) -> str:
    """Put a line into a section of the good specification, in place of the same key's line."""
    key = line.partition("=")[0].strip().replace("diamter", "diameter")
    text = "\n".join(kept for kept in GOOD.splitlines() if not kept.startswith(f"{key} ="))
    head = f"[{section}]"
    return text.replace(head, f"{head}\n{line}") if head in text else f"{text}\n{head}\n{line}\n"


def assert_begins(faults, expected):
    """Compare faults; an expected one that ends with … says only how it begins."""
    assert len(faults) == len(expected)
    for fault, text in zip(faults, expected, strict=True):
        assert fault == text or (text.endswith("…") and fault.startswith(text[:-1].rstrip()))


WRONG_VALUES = [
    ("fabric", "prestrain = 0", "must be greater than 0 and at most 2"),
    ("fabric", "prestrain = -0.3", "must be greater than 0 and at most 2"),
    ("fabric", "prestrain = 30", "must be greater than 0 and at most 2"),
    ("fabric", "poisson = 0.5", "must be greater than -1 and less than 0.5"),
    ("fabric", "poisson = 0.7", "must be greater than -1 and less than 0.5"),
    ("fabric", "poisson = -1", "must be greater than -1 and less than 0.5"),
    ("fabric", "thickness_mm = 0", "must be from 0.001 to 10"),
    ("fabric", "modulus_kPa = -700", "must be from 0.01 to 10000000"),
    ("fabric", "areal_density_g_m2 = 0", "must be from 0.1 to 100000"),
    ("wire", "diameter_mm = -0.5", "must be from 0.001 to 10"),
    ("wire", "diameter_mm = 0.0", "must be from 0.001 to 10"),
    ("wire", "diameter_mm = 11", "must be from 0.001 to 10"),
    ("wire", "modulus_hot_GPa = 0", "must be from 0.001 to 2000"),
    ("wire", "transition_C = -300", "must be from -200 to 1000"),
    ("wire", "resistivity_hot_uohm_cm = 0", "must be from 0.1 to 100000"),
    ("wire", "density_g_cm3 = 6450", "must be from 0.1 to 25"),
    ("layout", "rows = 0", "must be from 1 to 200"),
    ("layout", "columns = -4", "must be from 1 to 200"),
    ("layout", "loop_diameter_mm = 0.01", "must be from 0.1 to 10000"),
    ("model", "tolerance = 1", "must be from 1e-08 to 0.1"),
    ("stitching", "needle_margin_mm = 0.07", "must be from 0.08 to 2"),
    ("stitching", "couching_interval_mm = 0", "must be from 0.5 to 10"),
    ("stitching", "smallest_bend_diameters = 0", "must be from 1 to 1000"),
    ("machine", "longest_stitch_mm = 12.2", "must be from 2 to 12.1"),
    ("machine", "jumps_per_trim = 0", "must be from 1 to 20"),
    ("outline", "margin_mm = -2", "must be from 0.1 to 100"),
    ("outline", "corner_radius_mm = -1", "must be from 0 to 100"),
    ("wire", "diameter_mm = nan", "must be a finite number, from 0.001 to 10"),
    ("fabric", "prestrain = inf", "must be a finite number, greater than 0 and at most 2"),
    ("fabric", "poisson = -inf", "must be a finite number, greater than -1 and less than 0.5"),
    ("wire", 'diameter_mm = "0.5"', "must be a number from 0.001 to 10"),
    ("wire", 'diameter_mm = "0.5 mm"', "must be a number from 0.001 to 10"),
    ("wire", "diameter_mm = true", "must be a number from 0.001 to 10"),
    ("wire", "diameter_mm = [0.5]", "must be a number from 0.001 to 10"),
    ("wire", "diameter_mm = {cold = 0.5, hot = [1]}", "must be a number from 0.001 to 10"),
    ("wire", "diameter_mm = 2024-01-02", "must be a number from 0.001 to 10"),
    ("layout", "rows = 4.0", "must be a whole number from 1 to 200"),
    ("layout", "rows = false", "must be a whole number from 1 to 200"),
    ("layout", 'rows = "four"', "must be a whole number from 1 to 200"),
    ("output", "pictures = 1", "must be true or false"),
    ("output", 'pictures = "no"', "must be true or false"),
    ("machine", "name = 7", "must be 1 to 80 printable characters on one line"),
    ("machine", 'name = ""', "must be 1 to 80 printable characters on one line"),
    (
        "layout",
        'kind = "square"',
        'must be one of "grid", "brick", "hexagonal", "row", "circles", "sleeve"',
    ),
    ("layout", 'terminals = "up"', 'must be one of "corner", "left", "right", "top", "bottom"'),
    ("layout", "missing = [1, 2]", "must be a list, each item a row and a column, …"),
    ("layout", "circles = [[1, 2]]", "must be a list, each item with three numbers, …"),
    ("layout", 'between = "left"', 'must be one of "cut", "kept"'),
    ("layout", 'shape = "each"', 'must be one of "auto", "cell", "coupled", "none"'),
    ("model", 'fidelity = "scaling"', 'must be one of "auto", "compact", "mesh"'),
    ("model", "refinement = 4", "must be from 0 to 3"),
    (
        "model",
        'reading = "plane stress"',
        'must be one of "plane-stress", "published"; did you mean plane-stress?',
    ),
    (
        "output",
        'formats = ["dst", "hus", "jef"]',
        'must be a list, each item one of "dst", "exp", "u01", "pes", "jef", "vp3"',
    ),
    (
        "output",
        'formats = "dst"',
        'must be a list, each item one of "dst", "exp", "u01", "pes", "jef", "vp3"',
    ),
    (
        "layout",
        "loop_diameter_mm = 24.9",
        "must be at least 25: a smaller loop bends wire of 0.5 mm to a radius below …",
    ),
    ("output", 'paper = "a5"', 'must be one of "a4", "letter"'),
    ("output", "preview_thickness_mm = 0.6", "must be at most wire.diameter_mm = 0.5"),
]

WRONG_KEYS_AND_PAIRS = [
    (
        "layout",
        'between = "kept"\nshape = "cell"',
        'layout.shape = "cell": cannot be had: the fabric between the loops couples them …',
    ),
    ("layout", 'kind = "row"', 'layout.rows = 4: must be left out for layout.kind = "row"'),
    (
        "layout",
        "missing = [[1, 5]]",
        "layout.missing: there is no row 1 with a column 5 to leave out",
    ),
    (
        "layout",
        "circles = [{x_mm = 0, y_mm = 0, diameter_mm = 50}]",
        'layout.circles: must be left out for layout.kind = "grid"',
    ),
    (
        "wire",
        "modulus_cold_GPa = 28e9",
        "wire.modulus_cold_GPa = 28000000000.0: must be from 0.001 to 2000",
    ),
    ("layout", "rows = 1_000_000", "layout.rows = 1000000: must be from 1 to 200"),
    (
        "machine",
        "hoop_width_mm = 1e999",
        "machine.hoop_width_mm = inf: must be a finite number, from 10 to 10000",
    ),
    (
        "machine",
        'name = "two\\nlines"',
        'machine.name = "two\\u000Alines": must be 1 to 80 printable characters on one line',
    ),
    (
        "layout",
        "loop_diamter_mm = 50",
        "layout.loop_diamter_mm: unknown key; did you mean loop_diameter_mm?",
    ),
    ("fabric", "poission = 0.3", "fabric.poission: unknown key; did you mean poisson?"),
    (
        "fabric",
        "hoop_width_mm = 300",
        "fabric.hoop_width_mm: unknown key; did you mean machine.hoop_width_mm?",
    ),
    (
        "outline",
        "colour = 1",
        "outline.colour: unknown key; known here: margin_mm, corner_radius_mm",
    ),
    (
        "outline",
        '"a\\nb" = 1',
        'outline."a\\u000Ab": unknown key; known here: margin_mm, corner_radius_mm',
    ),
    ("fabrics", "prestrain = 0.3", "fabrics: unknown section or key; did you mean [fabric]?"),
    ("wire.coating", "x = 1", "wire.coating: unknown key; known here: diameter_mm, …"),
    ("wire", "diameter_mm = 9", "layout.loop_diameter_mm = 50: must be at least 450: …"),
    (
        "layout",
        "loop_diameter_mm = 0.5",
        "wire.diameter_mm = 0.5: must be less than layout.loop_diameter_mm = 0.5",
    ),
    (
        "layout",
        "columns = 9",
        "machine.hoop_width_mm = 406: must be at least 526.4 for the loops, …",
    ),
    (
        "layout",
        "rows = 6",
        "machine.hoop_height_mm = 330: must be at least 376.4 for the loops, …",
    ),
    (
        "stitching",
        "tail_length_mm = 100",
        "machine.hoop_height_mm = 330: must be at least 361.3 for …",
    ),
]


LINES = [(section, line, f"{section}.{line}: {problem}") for section, line, problem in WRONG_VALUES]


@pytest.mark.parametrize(("section", "line", "fault"), [*LINES, *WRONG_KEYS_AND_PAIRS])
def test_one_bad_line_gives_one_line_that_says_what_is_allowed(
    tmp_path, faults_of, section, line, fault
):
    path = tmp_path / "bad.toml"
    path.write_text(with_line(section, line))
    assert_begins(faults_of(path), [f"bad.toml: {fault}"])


MISSING = {
    "wire.diameter_mm": "missing; give the wire's diameter in mm",
    "layout.rows": "missing; give the number of rows of loops (a count)",
    "layout.columns": "missing; give the number of loops in a row (a count)",
    "layout.loop_diameter_mm": "missing; give the diameter in mm of the wire's centreline in a "
    "loop, in the hoop",
}


@pytest.mark.parametrize(("key", "problem"), MISSING.items())
def test_a_missing_key(tmp_path, faults_of, key, problem):
    path = tmp_path / "bad.toml"
    path.write_text(re.sub(rf"(?m)^{key.partition('.')[2]} = .*", "", GOOD))
    assert faults_of(path) == (f"bad.toml: {key}: {problem}",)


def test_a_file_name_that_cannot_be_the_designs_name(tmp_path, faults_of):
    path = tmp_path / "my array.toml"
    path.write_text(GOOD)
    (fault,) = faults_of(path)
    assert fault.startswith('my array.toml: name = "my array": must be 1 to 64 letters')


@pytest.mark.parametrize(
    ("key", "value", "fault"),
    [
        ("fabric.poisson", 0.7, "fabric.poisson = 0.7: must be greater than -1 and less than 0.5"),
        ("fabric.poison", 0.3, "fabric.poison: unknown key; did you mean poisson?"),
        ("fabrik.poisson", 0.3, None),
        ("prestrain", 0.3, "prestrain: unknown section or key; did you mean fabric.prestrain?"),
        ("wire.diameter_mm", None, "wire.diameter_mm = None: must be a number from 0.001 to 10"),
    ],
)
def test_a_bad_override_is_not_laid_to_the_file(tmp_path, faults_of, key, value, fault):
    path = tmp_path / "good.toml"
    path.write_text(GOOD)
    faults = faults_of(path, {key: value})
    assert len(faults) == 1
    expected = "good.toml: fabrik: unknown section or key; did you mean [fabric]?"
    assert faults[0] == (f"options: {fault}" if fault else expected)


def test_a_good_override_that_does_not_go_with_the_file_names_the_key(tmp_path, faults_of):
    path = tmp_path / "good.toml"
    path.write_text(GOOD)
    (fault,) = faults_of(path, {"wire.diameter_mm": 1.5})
    assert "layout.loop_diameter_mm = 50: must be at least 75" in fault


def test_an_override_below_a_section_that_is_none(tmp_path, faults_of):
    path = tmp_path / "bad.toml"
    path.write_text("fabric = 3\n" + GOOD)
    assert len(faults_of(path, {"fabric.prestrain": 0.2})) == 1


def test_a_mapping_names_its_source():
    with pytest.raises(InputError) as caught:
        specification_from({"wire": {"diameter_mm": 0.5}}, "x", "form")
    assert [fault.split(":")[:2] for fault in caught.value.faults] == [
        ["form", " layout.rows"],
        ["form", " layout.columns"],
        ["form", " layout.loop_diameter_mm"],
    ]


def test_the_message_is_the_faults_line_by_line():
    with pytest.raises(InputError) as caught:
        specification_from({}, "x")
    assert str(caught.value).splitlines() == list(caught.value.faults)
