"""Machine profiles: shipped ones are good, one's own are checked key by key, keys override them."""

import tomllib
from dataclasses import fields

import pytest

from patterns.machine import Machine
from sesame_cad.cli import COMMANDS
from sesame_cad.errors import InputError
from sesame_cad.specification import load_specification, specification_from
from sesame_cad.specification.machine import DEFAULT_PROFILE, MachineSection
from sesame_cad.specification.profile import profile_names, profile_text

SMALL = {"wire": {"diameter_mm": 0.3}, "layout": {"kind": "row", "columns": 1}}
SMALL["layout"]["loop_diameter_mm"] = 25


def spec_of(**sections):
    return specification_from({**SMALL, **sections}, "x")


def file_with(tmp_path, profile, more=""):
    (tmp_path / "mine.toml").write_text(profile)
    spec = tmp_path / "spec.toml"
    layout = 'kind = "row"\ncolumns = 1\nloop_diameter_mm = 25'
    spec.write_text(
        f'[wire]\ndiameter_mm = 0.3\n[layout]\n{layout}\n[machine]\nprofile = "mine.toml"\n{more}'
    )
    return spec


def test_the_default_profile_holds_the_defaults():
    table = tomllib.loads(profile_text(DEFAULT_PROFILE))
    assert set(table) == {"machine"}
    assert set(table["machine"]) == set(MachineSection.model_fields) - {"profile"}
    assert MachineSection(**table["machine"]) == MachineSection()


@pytest.mark.parametrize("name", profile_names())
def test_shipped_profiles_hold_every_key_and_are_good(name):
    assert set(tomllib.loads(profile_text(name))["machine"]) == set(MachineSection.model_fields) - {
        "profile"
    }
    assert spec_of(machine={"profile": name}).machine.profile == name


def test_a_single_needle_machine_leads_wire_by_hand_with_room():
    spec = spec_of(machine={"profile": "single-needle"})
    assert spec.patterns_machine().field_mm == (130, 180)
    assert spec.patterns_machine().hand_guided
    assert spec.patterns_stitching().needle_margin_mm == 0.3


def test_keys_of_the_specification_override_the_profiles():
    machine = {"profile": "single-needle", "hoop_width_mm": 240}
    spec = spec_of(machine=machine, stitching={"needle_margin_mm": 0.15})
    assert spec.machine.hoop_width_mm == 240
    assert spec.machine.hoop_height_mm == 190
    assert spec.stitching.needle_margin_mm == 0.15
    assert spec.stitching.cover_margin_mm == 0.3


def test_a_profile_of_ones_own_lies_beside_the_specification(tmp_path, monkeypatch):
    spec = file_with(tmp_path, "[machine]\nneedle_diameter_mm = 0.9\n", "hoop_width_mm = 200\n")
    found = load_specification(spec)
    assert found.machine.needle_diameter_mm == 0.9
    assert found.machine.hoop_width_mm == 200
    # what is written in full no longer needs the profile
    (tmp_path / "mine.toml").unlink()
    monkeypatch.chdir(tmp_path.parent)
    assert specification_from(found.model_dump(mode="json"), "x") == found


FAULTS = [
    ("needle_diameter = 0.9", "machine.needle_diameter: unknown key; did you mean needle_dia"),
    ("hoop_width_mm = -1", "machine.hoop_width_mm = -1: must be from 10 to 10000"),
    ('couching = "cord"', 'machine.couching = "cord": must be one of "zigzag", "centreline"'),
    ('threads = ["red"]', 'machine.threads = ["red"]: must be a list of four colours, each such'),
    ('profile = "single-needle"', "machine.profile: must be left out"),
]


@pytest.mark.parametrize(("line", "fault"), FAULTS)
def test_a_fault_of_a_profile_is_one_line(tmp_path, faults_of, line, fault):
    spec = file_with(tmp_path, f"[machine]\n{line}\n")
    (found,) = faults_of(spec)
    assert found.startswith(f"mine.toml: {fault}")


def test_all_faults_of_a_profile_at_once(tmp_path, faults_of):
    spec = file_with(tmp_path, "[machine]\nspeed_spm = 1\nstop_time_s = -1\n[wire]\nx = 1\n")
    assert [fault.split(":")[1].split()[0] for fault in faults_of(spec)] == [
        "wire",
        "machine.speed_spm",
        "machine.stop_time_s",
    ]


@pytest.mark.parametrize("text", ["[machine", "\0", "machine = 3"])
def test_a_profile_that_is_none(tmp_path, faults_of, text):
    (fault,) = faults_of(file_with(tmp_path, text))
    assert fault.startswith("mine.toml: ")


def test_unknown_and_missing_profiles(tmp_path, faults_of):
    with pytest.raises(InputError, match="did you mean single-needle"):
        spec_of(machine={"profile": "singel-needle"})
    spec = file_with(tmp_path, "")
    (tmp_path / "mine.toml").unlink()
    (fault,) = faults_of(spec)
    assert fault.startswith("mine.toml: cannot be read")
    with pytest.raises(InputError, match=r"machine\.profile = 3: must be"):
        spec_of(machine={"profile": 3})


def test_the_command_lists_and_prints(run_command, faults_of_command):
    assert "machines" in COMMANDS
    code, out, _ = run_command(["machines"])
    assert code == 0
    assert [line.split()[0] for line in out.splitlines()] == list(profile_names())
    assert run_command(["machines", "single-needle"])[1] == profile_text("single-needle")
    (fault,) = faults_of_command(["machines", "single"])
    assert "did you mean single-needle" in fault


def test_every_limit_of_the_geometry_is_a_key():
    assert {field.name for field in fields(Machine)} <= set(MachineSection.model_fields)


def test_a_design_for_a_demanding_machine_passes_its_check(run_command, run_design, tmp_path):
    spec = file_with(
        tmp_path,
        "[machine]\ndouble_stop = true\nrefuses_zero_colours = true\n",
        '[stitching]\nstripes = "rows"\ncover_underlay = "edge"\ncover_overlap_mm = 0.5\n',
    )
    folder = tmp_path / "made"
    data = run_design([str(spec), "-o", str(folder)])
    assert data["stitch"]["stops"] == len(data["stitch"]["blocks"]) - 1
    assert data["stitch"]["sewing_time_min"] > 10
    content = (folder / "stitch" / "spec.dst").read_bytes()
    doubled = sum(content[k] == 0xC3 for k in range(514, len(content), 3))
    assert doubled == 2 * data["stitch"]["stops"]
    code, out, err = run_command(["check", str(folder)])
    assert code == 0, out + err
