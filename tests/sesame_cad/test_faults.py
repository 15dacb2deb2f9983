"""Broken rules are drawn in red when that is asked for, and nothing else is written."""

import io
import json
import re
import shutil

import numpy as np
import pytest
from PIL import Image

from patterns.numbered_faults import MOST_NUMBERED, numbered_faults
from patterns.plan import StitchPlan
from patterns.records import plan_from_records, plan_records
from patterns.violation import Violation
from sesame_cad.files.dst import decode_dst, write_dst
from sesame_cad.package import write_package
from sesame_cad.package_files import file_data
from sesame_cad.pipeline import BrokenRulesError, pattern
from sesame_cad.specification import specification_from

ARRAY = {"rows": 1, "columns": 2, "loop_diameter_mm": 30, "shape": "none"}


def specification(**stitching):
    sections = {"wire": {"diameter_mm": 0.5}, "layout": ARRAY, "stitching": stitching}
    return specification_from(sections, "array", "test")


@pytest.fixture
def bad_file(tmp_path):
    """Locks so long that they are none."""
    file = tmp_path / "array.toml"
    file.write_text(specification(lock_length_mm=3.0).to_toml())
    return file


def test_refused_rules_come_with_pattern_and_places():
    with pytest.raises(BrokenRulesError) as caught:
        pattern(specification(lock_length_mm=3.0))
    assert {violation.rule for violation in caught.value.violations} == {"locks"}
    assert caught.value.pattern.plan.blocks


def circles(svg):
    """Left ends of the circles of a rule, on the page."""
    (group,) = re.findall(r'<g id="VIOLATIONS-locks".*?</g>', svg, re.DOTALL)
    (path,) = re.findall(r'<path d="(.*?)"', group)
    return [tuple(map(float, pair)) for pair in re.findall(r"M ([\d.]+),([\d.]+)", path)], group


def test_design_draws_faults_and_writes_nothing_else(bad_file, faults_of_command, tmp_path):
    target, picture = tmp_path / "out", tmp_path / "faults.svg"
    (fault,) = faults_of_command(
        ["design", str(bad_file), "-o", str(target), "--faults", str(picture)]
    )
    assert sorted(path.name for path in tmp_path.iterdir()) == ["array.toml", "faults.svg"]
    with pytest.raises(BrokenRulesError) as caught:
        pattern(specification(lock_length_mm=3.0))
    violations = caught.value.violations
    places, group = circles(picture.read_text())
    assert len(places) == len(violations)
    apart = np.diff([(v.x_mm, -v.y_mm) for v in violations], axis=0)
    np.testing.assert_allclose(np.diff(places, axis=0), apart, atol=2e-3)
    assert "stroke:#e00000" in group
    assert str(violations[0]).split(" at ")[0] in re.sub(
        r"</text>\s*<text[^>]*>", " ", picture.read_text()
    )
    assert f"and in {len(violations) - 1} more places" in fault


def test_a_bitmap_shows_red(bad_file, faults_of_command, tmp_path):
    picture = tmp_path / "faults.png"
    picture.write_bytes(b"an older one")
    faults_of_command(
        ["design", str(bad_file), "-o", str(tmp_path / "o"), "--faults", str(picture)]
    )
    pixels = np.asarray(Image.open(io.BytesIO(picture.read_bytes())).convert("RGB")).astype(int)
    red = np.abs(pixels - (224, 0, 0)).max(axis=2) < 20
    # Circles below the legend; the ten numbers alone would be less.
    assert np.sum(red[len(red) // 3 :]) > 1000


@pytest.mark.parametrize("name", ["faults.pdf", "faults"])
def test_other_pictures_are_refused_before_any_work(name, bad_file, faults_of_command):
    (fault,) = faults_of_command(["design", str(bad_file), "--faults", name])
    assert fault == f"error: --faults = '{name}': must end in .svg or .png"


def test_a_folder_in_the_picture_s_place_stays(bad_file, faults_of_command, tmp_path):
    (tmp_path / "it.svg").mkdir()
    faults = faults_of_command(["design", str(bad_file), "--faults", str(tmp_path / "it.svg")])
    assert "is no file" in faults[-1]
    assert list((tmp_path / "it.svg").iterdir()) == []


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    target = tmp_path_factory.mktemp("designs") / "array"
    write_package(specification(), target, lambda _: None)
    return target


def test_check_draws_what_is_wrong_with_the_stitch_file(package, tmp_path, run_command):
    folder = shutil.copytree(package, tmp_path / "array")
    spec, path = specification(), "stitch/array.dst"
    laid = pattern(spec).plan.blocks
    plan = plan_from_records(decode_dst((folder / path).read_bytes()).records, laid)
    plan.blocks[1].runs[0].needles[7:9] += 60
    content = write_dst(plan_records(StitchPlan(plan.blocks), spec.patterns_machine()), "array")
    (folder / path).write_bytes(content)
    data = json.loads((folder / "design.json").read_text())
    data["files"][path] = file_data(content)
    (folder / "design.json").write_text(json.dumps(data))
    picture = tmp_path / "faults.svg"
    code, out, _ = run_command(["check", str(folder), "--faults", str(picture)])
    assert code == 1
    x, y = plan.blocks[1].runs[0].needles[7] / 10
    assert f"({x:.2f}, {y:.2f}) mm, block 2, stitch 8" in out
    assert 'id="VIOLATIONS-wire-followed"' in picture.read_text()


def test_check_draws_nothing_when_all_is_well(package, tmp_path, run_command):
    picture = tmp_path / "faults.svg"
    code, _, _ = run_command(["check", str(package), "--faults", str(picture)])
    assert code == 0
    assert not picture.exists()


def test_numbers_go_through_all_rules_and_stop_at_ten():
    many = tuple(Violation("a", "m", float(k), 0.0) for k in range(MOST_NUMBERED + 3))
    first, second = numbered_faults(
        (*many, Violation("b", "n", 0.0, 0.0), Violation("b", "o", 0, 0))
    )
    assert len(first.others) == 3
    assert first.legend()[-1] == "a: 3 more places"
    assert [number for number, _ in second.numbered] == [11, 12]
    assert second.labels() == {(0.0, 0.0): "11, 12"}
