import json
from pathlib import Path

import numpy as np
import pytest

from sesame_cad.fitting.actuator import CHOICES, QUANTITIES, Parts, action
from sesame_cad.fitting.search import Bounds, fit

LARGE = str(Path(__file__).parents[2] / "examples" / "large-array.toml")
PARTS = Parts(700.0, 0.27, 0.45, 28.0, 75.0, "plane-stress")


@pytest.fixture
def fitted(run_command):
    def run(*arguments, code=0):
        ended, out, err = run_command(["fit", *arguments, "--json"])
        assert ended == code, err
        return json.loads(out), err

    return run


@pytest.mark.parametrize("k", range(3))
def test_slopes_as_differences(k):
    """Along x that is no solution, of everything that may be wanted."""
    choice = np.array([40.0, 0.4, 0.3])
    told = action(PARTS, choice, QUANTITIES)
    step = 1e-4 * choice[k] * np.eye(3)[k]
    above, below = (action(PARTS, choice + s * step, QUANTITIES).values for s in (1, -1))
    for key in QUANTITIES:
        slope = (above[key] - below[key]) / (2 * step[k])
        assert told.slopes[key][k] == pytest.approx(slope, rel=1e-3, abs=1e-4), CHOICES[k]


def test_what_a_design_does_leads_back_to_it():
    choice = np.array([37.0, 0.38, 0.3])
    wanted = dict(action(PARTS, choice, ("height_mm", "stroke_mm")).values)
    bounds = Bounds((20.0, 60.0), (0.3, 0.3), (0.3, 0.6), any_wire=True)
    answers = fit(PARTS, wanted, bounds, 1e-4)
    assert any(np.allclose(answer.choice, choice, rtol=1e-3) for answer in answers)
    assert answers[0].reached


def test_the_large_array_s_height_from_stock(fitted):
    data, _ = fitted("--like", LARGE, "--height", "21.98mm", "--wires", "0.38mm,0.5mm")
    assert data["feasible"]
    of_its_wire = [one for one in data["answers"] if one["wire_diameter_mm"] == 0.5]
    assert any(one["loop_diameter_mm"] == pytest.approx(50, rel=1e-3) for one in of_its_wire)
    spreads = [one["height_spread"] for one in data["answers"]]
    assert spreads == sorted(spreads)
    assert all(one["height_mm"] == pytest.approx(21.98, rel=0.01) for one in data["answers"])


def test_a_force(fitted):
    data, _ = fitted("--force", "500mN", "--wires", "0.38mm", "--loop-diameter", "20mm:60mm")
    (first, *_) = data["answers"]
    assert first["force_N"] == pytest.approx(0.5, rel=0.01)


def test_out_of_reach_gives_the_nearest(fitted):
    bounds = ["--wires", "0.38mm", "--loop-diameter", "30mm:40mm"]
    data, err = fitted("--height", "100mm", *bounds, code=1)
    assert not data["feasible"]
    nearest = data["answers"][0]
    assert nearest["loop_diameter_mm"] == pytest.approx(40, rel=1e-6)
    assert nearest["at_bounds"] == ["loop_diameter_mm"]
    assert "height_mm = 100: out of reach" in err
    assert "at its bound: loop_diameter_mm" in err


def test_nothing_buckles(fitted):
    data, err = fitted("--height", "5mm", "--wires", "2mm", "--loop-diameter", "20mm", code=1)
    assert data["answers"] == []
    assert "no loop within the bounds buckles" in err


def test_a_map_of_heights(fitted, tmp_path):
    (tmp_path / "map.csv").write_text("12,10\n10,12\n")
    cells, _ = fitted(
        "--heights", str(tmp_path / "map.csv"), "--pitch", "25mm", "--wires", "0.4mm:0.41mm"
    )
    assert [cell["wanted_height_mm"] for cell in cells["cells"]] == [12, 10, 10, 12]
    for cell in cells["cells"]:
        assert cell["pitch_mm"] == pytest.approx(25, rel=0.01)
        assert cell["height_mm"] == pytest.approx(cell["wanted_height_mm"], rel=0.01)


@pytest.mark.parametrize(
    ("arguments", "fault"),
    [
        ([], "fit what?"),
        (["--height", "12"], "--height: '12' has no unit"),
        (["--height", "0mm"], "--height: '0mm': must be greater than 0"),
        (["--force", "3mm"], "--force: '3mm' is not a force"),
        (
            ["--height", "9mm", "--loop-diameter", "9mm:3mm"],
            "--loop-diameter: '9mm:3mm': the first",
        ),
        (["--height", "9mm", "--prestrain", "0.1:0.2:3"], "--prestrain: '0.1:0.2:3': write one"),
        (["--height", "9mm", "--prestrain", "3"], "--prestrain: '3': must be from"),
        (["--height", "9mm", "--wires", "thin"], "--wires: 'thin' is not a length"),
        (["--height", "9mm", "--within", "60%"], "--within: '60%': must be from"),
        (["--heights", "x.csv"], "--heights: give --pitch"),
        (["--heights", "no-such.csv", "--pitch", "20mm"], "no-such.csv: cannot be read"),
    ],
)
def test_bad_requests(arguments, fault, faults_of_command):
    (said,) = faults_of_command(["fit", *arguments])
    assert said.startswith(f"error: {fault}")


@pytest.mark.parametrize(
    ("text", "fault"),
    [("10,x\n", "'x': must be a height"), ("1,2\n3\n", "equally many"), ("\n", "no heights")],
)
def test_bad_maps(text, fault, faults_of_command, tmp_path):
    (tmp_path / "map.csv").write_text(text)
    arguments = ["fit", "--heights", str(tmp_path / "map.csv"), "--pitch", "20mm"]
    (said,) = faults_of_command(arguments)
    assert fault in said
