"""Packages of sleeves: both hoopings, sheets, numbers; and a check that finds what is spoilt."""

import json
import re
import shutil
from html import escape
from math import pi
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import sesame_cad
from patterns.plan import UNITS_PER_MM, BlockKind
from patterns.records import plan_from_records
from sesame_cad.errors import InputError
from sesame_cad.files.cut_line import cut_line
from sesame_cad.files.cut_svg import cut_line_path, mat_sheet
from sesame_cad.files.dst import decode_dst, write_dst
from sesame_cad.package import write_package
from sesame_cad.package_files import file_data
from sesame_cad.report.embedding import read_embedded
from sesame_cad.report.stitch_view import viewed_records
from sesame_cad.sleeve.design import sleeve_design
from sesame_cad.sleeve.hold import hold
from sesame_cad.sleeve.hoops import upper_hoop
from sesame_cad.specification import load_specification, specification_from
from sesame_cad.verification import verified, verify

EXAMPLE = Path(__file__).parents[2] / "examples" / "beam-sleeves.toml"
SMALL = {
    "wire": {"diameter_mm": 0.3},
    "layout": {
        "kind": "sleeve",
        "rows": 2,
        "columns": 2,
        "loop_diameter_mm": 25,
        "shape": "none",
    },
    "beam": {
        "length_mm": 70,
        "width_mm": 14,
        "hook_height_mm": 2,
        "constraint_length_mm": 68,
    },
    "stitching": {"tail_length_mm": 20},
    "output": {"pictures": False},
}


@pytest.fixture(scope="module")
def spec():
    return specification_from(SMALL, "small")


@pytest.fixture(scope="module")
def made(spec):
    return sleeve_design(spec)


@pytest.fixture(scope="module")
def package(spec, tmp_path_factory):
    target = tmp_path_factory.mktemp("sleeves") / "small"
    write_package(spec, target, lambda _: None)
    return target


@pytest.fixture
def spoilt(package, tmp_path):
    """Copy the package, and give a way to change a file so that its hash is right again."""
    folder = tmp_path / "small"
    shutil.copytree(package, folder)

    def change(path, content):
        (folder / path).write_bytes(content)
        data = json.loads((folder / "design.json").read_text())
        data["files"][path] = file_data(content)
        (folder / "design.json").write_text(json.dumps(data))
        return folder

    return change


def layer_plan(package, made, name):
    hooping = made.hoopings[name]
    data = (package / "stitch" / f"small-{name}.dst").read_bytes()
    records = decode_dst(data, made.spec.dst_switches()).records
    return plan_from_records(records, hooping.pattern.plan.blocks)


def test_the_files_are_those_of_two_hoopings_and_of_the_sheets(package):
    found = {file.relative_to(package).as_posix() for file in package.rglob("*") if file.is_file()}
    layers = {
        f"{folder}/small-{layer}{ending}"
        for layer in ("lower", "upper")
        for folder, endings in (
            ("stitch", (".dst", ".blocks.csv")),
            ("cut", (".svg", ".dxf")),
            ("worksheet", (".pdf",)),
        )
        for ending in endings
    }
    sheets = {f"cut/small-{one}.{kind}" for one in ("beams", "coupon") for kind in ("svg", "dxf")}
    assert found == layers | sheets | {"plan/small.svg", "report.html", "design.json"}


def test_the_program_makes_the_same_bytes_again_and_checks_them(
    package, spec, run_command, tmp_path
):
    path = tmp_path / "small.toml"
    path.write_text(spec.to_toml())
    code, out, err = run_command(["design", str(path), "-o", str(tmp_path / "again")])
    assert (code, err) == (0, "")
    assert "2 of 70 × 14 × 0.38 mm" in out
    for file in package.rglob("*"):
        if file.is_file():
            again = tmp_path / "again" / file.relative_to(package)
            assert again.read_bytes() == file.read_bytes()
    code, out, _ = run_command(["check", str(package)])
    assert code == 0
    assert "every file is as it should be" in out


def test_both_layers_share_registration_marks_and_neither_is_mirrored(package, made):
    lower, upper = (layer_plan(package, made, name).blocks[0] for name in ("lower", "upper"))
    assert lower.kind is upper.kind is BlockKind.MARKS
    runs = [run.needles.tolist() for run in lower.runs]
    assert all(run.needles.tolist() in runs for run in upper.runs)
    assert len(runs) == len(upper.runs) + 4  # the corners of the frame
    mark = made.pattern.upper.marks[0]  # the F
    assert mark.x_mm < 0 < mark.y_mm
    letter = np.concatenate(mark.strokes)
    assert np.mean(letter[:, 0] < mark.x_mm) > 0.5  # its stem is on the left


def test_only_the_lower_layer_ends_with_ties(package, made):
    kinds = {
        name: [block.kind for block in layer_plan(package, made, name).blocks]
        for name in ("lower", "upper")
    }
    assert kinds["lower"][-2:] == [BlockKind.STRIPES, BlockKind.TIES]
    assert BlockKind.TIES not in kinds["upper"]
    say = made.pattern.lower.plan.blocks[-1].instruction
    assert "right side up" in say
    assert "frame with the beams" in say


@pytest.mark.parametrize(("upper", "side"), [("opposite", 1), ("same", -1)])
def test_tails_leave_at_the_end_that_is_asked_for(upper, side):
    data = SMALL | {"sleeve": {"upper_terminals": upper}}
    pattern = sleeve_design(specification_from(data, "small")).pattern
    for layer, way in ((pattern.lower, -1), (pattern.upper, side)):
        for part in layer.circuit.parts:
            assert np.sign(part.wire.at(0.0)[0][0, 0]) == way


def test_the_numbers_of_beams_are_those_of_the_section(package):
    data = json.loads((package / "design.json").read_text())
    beams, strip = data["beams"], data["beams"]["constraint"]
    assert beams["count"] == strip["count"] == 2
    assert beams["hole_positions_mm"] == [6, 64]
    assert strip["hole_positions_mm"] == [6, 62]
    assert strip["window_mm"] == pytest.approx(25 + 0.3 + 4 + 2)
    # corners are as round outside as in the window, and cancel
    width = strip["window_mm"] + 8
    assert strip["width_mm"] == pytest.approx(width)
    area = 68 * width - (68 - 24) * strip["window_mm"] - 2 * pi * 3**2 / 4
    assert strip["mass_g"] == pytest.approx(area * 0.38 * 1.2e-3)
    assert beams["mass_g"] > (70 * 14 - (4 - pi) * 2**2 - 2 * pi * 3**2 / 4) * 0.38 * 1.2e-3
    assert data["sleeve"] is data["bistable"] is beams["hold"] is None
    for layer in data["hoopings"].values():
        assert [one["name"][-1] for one in layer["circuits"]] == ["1", "2"]
        assert layer["circuit"]["closed"]
        assert layer["circuit"]["covered_contacts"] == layer["circuit"]["contacts"] == 2
        assert layer["electrics"]["sewn_net"]["shorts"] == 0


def test_without_a_frame_each_beam_is_a_piece_with_marks_of_its_own():
    data = SMALL | {"beam": SMALL["beam"] | {"frame_tabs": False}}
    pattern = sleeve_design(specification_from(data, "small")).pattern
    assert len(pattern.cutting.laid) == 2
    assert len(pattern.lower.marks) == len(pattern.upper.marks) + 4


def test_a_needle_that_was_moved_onto_a_beam_is_found(spoilt, package, made, spec):
    path = "stitch/small-lower.dst"
    records = decode_dst((package / path).read_bytes(), spec.dst_switches()).records
    plan = made.pattern.lower.plan
    needle = plan.blocks[-1].runs[-1].needles[1]
    at = int(np.flatnonzero(np.all(records.xy == needle, axis=1))[0])
    records.xy[at] = (needle[0], needle[1] - 6 * UNITS_PER_MM)
    folder = spoilt(path, write_dst(records, "small-lower", spec.dst_switches()))
    faults = "\n".join(verify(folder))
    assert "tie-on-beam: the needle comes too near to a beam" in faults
    assert f"{path}: record {at + 1}" in faults
    assert verified(folder).sewn.spec.name == "small-lower"


@pytest.mark.parametrize("kind", ["svg", "dxf"])
def test_a_sheet_that_was_changed_is_found(spoilt, package, kind):
    path = f"cut/small-beams.{kind}"
    text = (package / path).read_text()
    old, new = ('r="1.5000"', 'r="1.4000"') if kind == "svg" else ("\n 40\n1.5\n", "\n 40\n1.4\n")
    assert old in text
    faults = verify(spoilt(path, text.replace(old, new, 1).encode()))
    assert len(faults) == 1
    assert faults[0].startswith(path)


def test_the_report_shows_the_stitches_of_both_layers_and_every_sheet(package, made):
    page = (package / "report.html").read_text(encoding="utf-8")
    for layer, hooping in made.hoopings.items():
        shown = viewed_records(read_embedded(page, f"stitch-data-{layer}"))
        assert shown.same_as(made.records[layer])
        assert f'data-stitches="stitch-data-{layer}"' in page
        for block in hooping.pattern.plan.blocks:
            assert escape(block.instruction) in page
    for sheet in made.pattern.cutting.sheets:
        for line in (line for line in map(cut_line, sheet.cuts) if not line.is_circle):
            assert cut_line_path(mat_sheet(sheet.nested.mat), line) in page
    assert "No states are predicted" in page
    assert not re.findall(r'(?:src|href)="(?!data:|#)[a-z]+:', page)


def test_a_report_that_shows_other_stitches_is_found(spoilt, package):
    page = (package / "report.html").read_text(encoding="utf-8")
    swapped = page.replace("stitch-data-lower", "stitch-data-none").replace(
        "stitch-data-upper", "stitch-data-lower"
    )
    faults = verify(spoilt("report.html", swapped.encode()))
    assert faults == (
        "report.html: upper array: the page holds no data named stitch-data-upper",
        "report.html: lower array: its stitches are not those of the DST file",
    )


def test_python_programs_get_values_and_the_same_folder(package, tmp_path):
    found = sesame_cad.design(SMALL | {"name": "small"})
    assert isinstance(found, sesame_cad.DesignedSleeves)
    assert found.prediction is found.hold is None
    assert found.data["beams"]["count"] == found.pattern.cutting.count == 2
    found.write(tmp_path / "again")
    for file in package.rglob("*"):
        if file.is_file():
            assert (
                tmp_path / "again" / file.relative_to(package)
            ).read_bytes() == file.read_bytes()
    shown = found._repr_html_()
    assert "2 of 70 × 14 × 0.38 mm" in shown
    assert shown.count("<img ") == 2


def test_joined_rows_are_one_circuit_in_each_array(tmp_path):
    spec = specification_from(SMALL | {"sleeve": {"rows_joined": 2}}, "small")
    data = write_package(spec, tmp_path / "small", lambda _: None)
    for layer in data["hoopings"].values():
        (circuit,) = layer["circuits"]
        assert circuit["loops"] == [0, 1, 2, 3]
        assert layer["circuit"]["closed"]
        assert layer["electrics"]["sewn_net"]["shorts"] == 0
    assert verify(tmp_path / "small") == ()


def test_what_is_missing_or_untrue_is_found(spoilt, package):
    folder = spoilt("plan/small.svg", (package / "plan/small.svg").read_bytes())
    (folder / "cut/small-coupon.svg").unlink()
    data = json.loads((folder / "design.json").read_text())
    data["beams"]["mass_g"] *= 1.01
    (folder / "design.json").write_text(json.dumps(data))
    faults = verify(folder)
    assert "cut/small-coupon.svg: missing" in faults
    assert any(fault.startswith("design.json: beams: mass_g") for fault in faults)


def test_what_is_predicted_is_in_the_package_and_checked(tmp_path):
    layout = SMALL["layout"] | {"rows": 1, "shape": "auto"}
    spec = specification_from(SMALL | {"layout": layout}, "small")
    data = write_package(spec, tmp_path / "small", lambda _: None)
    assert data["sleeve"]["force_N"]["hot"] > data["sleeve"]["force_N"]["cold"] > 0
    assert data["bistable"]["length_mm"] == pytest.approx(58)
    assert (
        data["beams"]["hold"]["tie_from_axis_mm"]["cold"] < data["beams"]["hold"]["hook_reach_mm"]
    )
    solids = sorted(path for path in data["files"] if path.endswith(".stl"))
    assert len(solids) == 8
    # a sleeve in the place of a beam, with its hash right
    beam, sleeve = tmp_path / "small" / solids[0], tmp_path / "small" / solids[2]
    beam.write_bytes(sleeve.read_bytes())
    data["files"][solids[0]] = data["files"][solids[2]]
    (tmp_path / "small" / "design.json").write_text(json.dumps(data))
    faults = verify(tmp_path / "small")
    assert faults
    assert all(fault.startswith(f"{solids[0]}: ") and "predicted" in fault for fault in faults)


def test_the_upper_hoop_lies_inside_the_lower_one(spec, made):
    points = list(made.pattern.upper.outline.outsides)
    points += [run.needles / UNITS_PER_MM for run in made.pattern.upper.plan.blocks[0].runs]
    reach = 2 * np.abs(np.concatenate(points)).max(axis=0)  # marks lie around all else
    assert made.hoop.inside_mm == pytest.approx(reach)
    assert np.subtract(made.hoop.outside_mm, made.hoop.inside_mm) == pytest.approx([20, 20])
    assert "hoop of at least" in made.hoopings["upper"].spec.output.notes
    assert "hoop of at least" not in made.hoopings["lower"].spec.output.notes
    wide = spec.sleeve.model_copy(update={"upper_hoop_rim_mm": 200.0})
    with pytest.raises(InputError) as caught:
        upper_hoop(spec.model_copy(update={"sleeve": wide}), made.pattern.upper)
    width, height = caught.value.faults
    assert "machine.hoop_width_mm = 406: must be at least" in width
    assert "machine.hoop_height_mm = 330: must be at least" in height


def couples(cold_mm, hot_mm):
    """A prediction of which only the places of the ties count."""

    def couple(place_mm):
        def points_m(radius, angle):
            assert radius == pytest.approx(1 - 1.5 / 17.5)
            assert angle == pytest.approx(np.radians(70))
            return np.array([[0.0, place_mm * 1e-3, 0.0]])

        return SimpleNamespace(pressed=SimpleNamespace(points_m=points_m))

    return SimpleNamespace(cold=couple(cold_mm), hot=couple(hot_mm))


def test_hooks_must_reach_the_ties_and_the_beam_must_not():
    spec = load_specification(EXAMPLE)
    held = hold(spec, couples(11.0, 13.7))
    assert held.hot_too
    assert held.reach_mm == pytest.approx(13.8)
    assert not hold(spec, couples(11.0, 13.9)).hot_too
    with pytest.raises(InputError, match=r"hook_height_mm = 3\.8: must be at least 4\.00"):
        hold(spec, couples(14.0, 15.0))
    with pytest.raises(InputError, match=r"width_mm = 20: must be at most 19\.80"):
        hold(spec, couples(9.9, 15.0))
