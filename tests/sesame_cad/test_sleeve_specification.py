"""Specifications of sleeves: what follows from them, and every fault in one line."""

import tomllib
from pathlib import Path

import pytest

from patterns.beam_rules import check_beam, check_constraint
from sesame_cad.specification import load_specification, specification_from

EXAMPLE = Path(__file__).parents[2] / "examples" / "beam-sleeves.toml"


def sleeve(**changes):
    """Load the example with some keys changed, given as section__key."""
    overrides = {key.replace("__", "."): value for key, value in changes.items()}
    return load_specification(EXAMPLE, overrides)


def test_the_example_is_six_beams_with_rows_apart():
    spec = sleeve()
    loops = spec.layout.loops()
    assert len(loops) == 24
    assert {loop.cell for loop in loops} == {(r, c) for r in range(6) for c in range(4)}
    assert sorted({loop.y_mm for loop in loops}) == pytest.approx(
        [43 * (k - 2.5) for k in range(6)]
    )
    assert sorted({loop.x_mm for loop in loops}) == pytest.approx(
        [35 * (k - 1.5) for k in range(4)]
    )


def test_left_to_itself_the_sleeve_fills_half_of_the_beam_and_its_pieces_keep_the_rules():
    spec = sleeve()
    place, beam = spec.sleeve_place, spec.beam.beam(spec.sleeve_place)
    assert place.end_mm == pytest.approx(spec.beam.length_mm / 2)
    assert place.length_mm == pytest.approx(4 * spec.compressed_pitch_mm)
    assert not check_beam(beam, spec.beam.limits)
    assert not check_constraint(spec.constraint, beam, spec.beam.limits)
    longer = load_specification(
        EXAMPLE, {"sleeve.compressed_pitch_mm": spec.compressed_pitch_mm + 0.1 - 0.1}
    )
    assert longer.sleeve_place == place


def test_the_right_half_is_the_left_one_mirrored():
    left = sleeve(sleeve__compressed_pitch_mm=15.0).sleeve_place
    right = sleeve(sleeve__compressed_pitch_mm=15.0, sleeve__half="right").sleeve_place
    assert left.start_mm + right.end_mm == pytest.approx(160)
    assert left.length_mm == right.length_mm == 60


def test_a_sleeve_passes_through_the_constraint_s_window():
    spec = sleeve()
    strip = spec.constraint
    sewn = 35 + 0.38 + 2 * 2.0  # loop, wire, fabric on both sides
    assert strip.window_mm == pytest.approx(sewn + 2)
    assert strip.width_mm == pytest.approx(sewn + 2 + 2 * 4)
    # it begins past the window's end, which is as far from the strip's end as twice the hole
    assert spec.sleeve_place.start_mm == pytest.approx(2 * 6 + 1)


def test_it_is_written_and_read_back():
    spec = sleeve(beam__mat="sheet", sleeve__half="right")
    assert specification_from(tomllib.loads(spec.to_toml()), "x") == spec


@pytest.mark.parametrize(
    ("key", "value", "named", "said"),
    [
        ("beam.constraint_length_mm", 160, "beam.constraint_length_mm = 160", "must be less than"),
        ("beam.constraint_length_mm", 14, "beam.constraint_length_mm = 14", "at least 28 "),
        ("beam.width_mm", 11, "beam.width_mm = 11", "must be at least 12 for holes"),
        ("beam.width_mm", 21, "beam.width_mm = 21", "must be at most 20.1202"),
        ("beam.corner_radius_mm", 11, "beam.corner_radius_mm = 11", "must be at most 10"),
        ("sleeve.compressed_pitch_mm", 17.3, "sleeve.compressed_pitch_mm = 17.3", "at most 16.75"),
        ("layout.columns", 1, "sleeve.compressed_pitch_mm", "give it, or take a shorter"),
        ("sleeve.rows_joined", 4, "sleeve.rows_joined = 4", "must divide layout.rows = 6"),
        ("beam.constraint_rail_mm", 140, 'beam.mat = "scanncut-12x12"', "too small: a constraint"),
        ("layout.row_pitch_mm", 38, "layout.row_pitch_mm = 38", "must be at least 38.75"),
        ("sleeve.tie_length_mm", 2, "sleeve.tie_length_mm = 2", "must be at least 2.73"),
        ("layout.rows", 7, 'beam.mat = "scanncut-12x12"', "too small: the frame with all beams"),
        ("layout.between", "kept", 'layout.between = "kept"', 'must be "cut"'),
        ("layout.missing", [[1, 1]], "layout.missing = [[1, 1]]", "must be []"),
        ("layout.axis_ratio", 1.2, "layout.axis_ratio = 1.2", "must be 1.0"),
        ("layout.terminals", "top", 'layout.terminals = "top"', '"left" or "right"'),
        ("layout.shape", "cell", 'layout.shape = "cell"', 'must be "auto" or "none"'),
        ("stitching.stripes", "rows", 'stitching.stripes = "rows"', 'must be "none" or "columns"'),
        ("stitching.ties", "contacts", 'stitching.ties = "contacts"', 'must be "none"'),
        ("wiring.split", "auto", 'wiring.split = "auto"', 'must be "none"'),
        ("layout.kind", "grid", "beam", "given: "),
    ],
)
def test_one_wrong_key_gives_one_line_that_names_it(key, value, named, said, faults_of):
    overrides = {key: value}
    if key == "layout.kind":
        overrides["beam.length_mm"] = 150
    faults = faults_of(EXAMPLE, overrides)
    assert len(faults) == 1, faults
    assert named in faults[0]
    assert said in faults[0]


def test_a_pitch_of_rows_belongs_to_sleeves_only(tmp_path, faults_of):
    path = tmp_path / "grid.toml"
    path.write_text(
        "[wire]\ndiameter_mm = 0.5\n[layout]\nrows = 2\ncolumns = 2\nloop_diameter_mm = 50\n"
        "row_pitch_mm = 60\n"
    )
    assert faults_of(path) == (
        'grid.toml: layout.row_pitch_mm = 60: must be left out for layout.kind = "grid": it '
        'belongs to "sleeve"',
    )
