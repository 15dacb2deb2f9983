"""`sesame-cad force`: the figures, the account of them, and input that cannot be."""

import csv
import json

import pytest

SPEC = """
[wire]
diameter_mm = 0.5
transition_C = 60
[layout]
rows = 1
columns = 1
loop_diameter_mm = 50
"""


@pytest.fixture
def spec(tmp_path):
    path = tmp_path / "loop.toml"
    path.write_text(SPEC)
    return str(path)


@pytest.fixture
def run_force(run_command, spec):
    def run(*arguments):
        code, out, err = run_command(["force", spec, *arguments, "--json"])
        assert code == 0, err
        return json.loads(out)

    return run


@pytest.mark.parametrize(("gap", "cold", "hot"), [("30mm", 0.32, 1.46), ("2cm", 1.2, 3.3)])
def test_figures_of_a_mesh_with_springy_plates(run_force, gap, cold, hot):
    data = run_force("--gap", gap, "--poisson", "0.3")
    assert data["cold"]["force_N"] == pytest.approx(cold, rel=0.05)
    assert data["hot"]["force_N"] == pytest.approx(hot, rel=0.05)
    for state in (data["cold"], data["hot"]):
        assert state["converged"]
        assert state["gradient_norm"] < 1e-6
        assert state["lowest_eigenvalue"] > 0
        assert sum(c["force_N"] for c in state["contacts"] if c["plate"] == "upper") == (
            pytest.approx(state["force_N"])
        )
        assert {term["term"] for term in state["omitted_terms"]} >= {"gravity"}


@pytest.mark.parametrize("axis", ["lateral", "height"])
def test_a_gap_wider_than_the_loop_needs_no_force(run_force, axis):
    data = run_force("--gap", "100mm", "--axis", axis)
    assert (data["cold"]["force_N"], data["hot"]["force_N"]) == (0, 0)
    assert data["cold"]["contacts"] == []
    assert data["cold"]["height_mm"] == pytest.approx(21.98, abs=0.01)


def test_pressed_from_above_the_hot_loop_gives_way(run_force):
    data = run_force("--gap", "20mm", "--axis", "height")
    assert data["cold"]["force_N"] == pytest.approx(0.633, rel=0.01)
    assert data["hot"]["force_N"] == 0
    assert data["cold"]["height_mm"] == pytest.approx(20)


def test_the_gap_can_count_to_the_surface(run_force):
    inner = run_force("--gap", "29.5mm", "--points", "2")
    outer = run_force("--gap", "30mm", "--measured-to", "surface")
    assert outer["cold"]["force_N"] == pytest.approx(inner["cold"]["force_N"], rel=5e-3)


def test_curve_of_gaps(run_force, tmp_path):
    target = tmp_path / "forces"
    data = run_force("--gaps", "15..40mm", "--points", "3", "--gap", "60mm", "-o", str(target))
    assert [point["gap_mm"] for point in data["curve"]] == [15, 27.5, 40, 60]
    first = data["curve"][0]
    assert first["cold"]["force_N"] is None
    assert "raise the gap" in first["cold"]["status"]
    assert first["hot"]["force_N"] == pytest.approx(6.03, rel=0.02)
    rows = list(csv.DictReader((target / "curves" / "gap.csv").read_text().splitlines()))
    assert [row["force_hot_N"] for row in rows[-1:]] == ["0"]
    assert rows[0]["force_cold_N"] == ""
    listed = json.loads((target / "force.json").read_text())
    assert set(listed["files"]) == {"curves/gap.csv", "pictures/gap.png"}
    assert listed == data


def test_force_against_temperature(run_force, tmp_path):
    target = str(tmp_path / "forces")
    options = ["--temperatures", "0..100C", "--points", "5", "-o", target]
    data = run_force("--gap", "25mm", *options)
    ways = {(one["way"], one["temperature_C"]): one["force_N"] for one in data["temperatures"]}
    cold, hot = data["cold"]["force_N"], data["hot"]["force_N"]
    assert ways["heating", 0] == ways["heating", 50] == pytest.approx(cold, rel=0.01)
    assert ways["cooling", 50] == ways["cooling", 100] == pytest.approx(hot, rel=0.01)
    # 0, 25, 50, 75 and 100 °C alone would step over all of the way from 60 to 70 °C
    rising = [ways["heating", t] for t in (60, 62.5, 65, 67.5, 70)]
    assert rising == sorted(rising)
    assert rising[1] - cold > 0.05 * (hot - cold)


@pytest.mark.parametrize(
    ("options", "fault"),
    [
        (["--gap", "0mm"], "--gap: 0 mm must be greater than 0"),
        (["--gap", "-5mm"], "--gap: -5 mm must be greater than 0"),
        (["--gap", "nan"], "--gap: 'nan' is not a length"),
        (["--gap", "inf"], "--gap: 'inf' is not a length"),
        (["--gap", "20"], "--gap: '20' has no unit: write 20mm"),
        (["--gap", "0.4mm", "--measured-to", "surface"], "greater than wire.diameter_mm = 0.5"),
        (["--gaps", "30..15mm"], "--gaps: '30..15mm': the first must be less than the second"),
        (["--gaps", "30mm"], "--gaps: '30mm' is not a range"),
        ([], "--gap: missing"),
        (["--gap", "20mm", "--poisson", "0.7"], "fabric.poisson"),
        (["--gaps", "20..30mm", "--temperatures", "0..9C"], "--temperatures: needs one gap"),
        (["--gap", "20mm", "--temperatures", "0..9mm"], "--temperatures: "),
    ],
)
def test_input_that_cannot_be(faults_of_command, spec, options, fault):
    (said,) = faults_of_command(["force", spec, *options])
    assert fault in said


def test_no_shape_is_an_error_with_a_remedy(run_command, spec, tmp_path):
    target = tmp_path / "forces"
    code, out, err = run_command(["force", spec, "--gap", "8mm", "-o", str(target)])
    assert (code, out) == (1, "")
    assert "cold, gap 8 mm: " in err
    assert "wider gap" in err
    assert not target.exists()


def test_arrays_of_unequal_loops_are_refused(faults_of_command, tmp_path):
    path = tmp_path / "brick.toml"
    path.write_text(SPEC.replace("rows = 1", 'kind = "brick"\nrows = 2').replace("s = 1", "s = 2"))
    (said,) = faults_of_command(["force", str(path), "--gap", "20mm"])
    assert "equal circles on a square grid" in said
