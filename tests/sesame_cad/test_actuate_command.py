"""`sesame-cad actuate`: what it writes agrees with itself, with the paper, and in extremes."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest

from sesame_cad.actuation.course import actuate, solved_cell
from sesame_cad.actuation.course_data import actuation_data
from sesame_cad.actuation.course_files import actuation_files
from sesame_cad.actuation.subject import transformation
from sesame_cad.errors import InputError
from sesame_cad.specification import load_specification, specification_from
from sesame_cad.staging import _check_replaceable

EXAMPLES = Path(__file__).parents[2] / "examples"
SMALL = {
    "wire": {"diameter_mm": 0.3, "transition_C": 60, "current_A": 0.6},
    "layout": {"rows": 1, "columns": 2, "loop_diameter_mm": 25},
    "output": {"pictures": False},
}


def spec_of(wire=None, **actuation):
    sections = SMALL | {"actuation": actuation, "wire": SMALL["wire"] | (wire or {})}
    return specification_from(sections, "pair")


@pytest.fixture(scope="module")
def solved():
    """The cell of the pair, and of the paper's small array."""
    return solved_cell(spec_of())


@pytest.fixture(scope="module")
def made_of(solved):
    """Actuate the pair with other heat and load."""
    return lambda current_A=None, **heat: actuate(spec_of(**heat), current_A, solved=solved)


@pytest.fixture(scope="module")
def lifting(made_of):
    return made_of(load_g=2.0, cooling_s=60.0)


def test_everything_is_written_and_can_be_made_again(run_command, tmp_path, solved):
    spec = tmp_path / "pair.toml"
    spec.write_text(spec_of().to_toml().replace("pictures = false", "pictures = true"))
    folder = tmp_path / "out"
    code, out, err = run_command(["actuate", str(spec), "-o", str(folder), "--json"])
    assert code == 0, err
    data = json.loads(out)
    assert data == json.loads((folder / "actuation.json").read_text())
    files = [path for path in folder.rglob("*") if path.is_file()]
    one = {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}
    again = actuate(load_specification(spec), solved=solved)
    assert actuation_files(again) == {k: v for k, v in one.items() if k != "actuation.json"}
    assert actuation_data(again) | {"files": data["files"]} == data
    assert set(one) == {"actuation.json", *data["files"]}
    assert {"curves/path.csv", "curves/time.csv", "curves/load.csv"} < set(one)
    assert {"pictures/path.png", "pictures/time.png", "pictures/load.png"} < set(one)
    check_path_table(folder / "curves" / "path.csv")
    with pytest.raises(InputError, match=r"holds files but no design\.json"):
        _check_replaceable(folder, "design.json")
    folder.joinpath("mine.txt").write_text("keep")
    with pytest.raises(InputError, match=r"holds mine\.txt, which its actuation\.json does not"):
        _check_replaceable(folder, "actuation.json")


def check_path_table(file):
    rows = list(csv.DictReader(file.read_text().splitlines()))
    assert [row["way"] for row in rows] == ["heating"] * 25 + ["cooling"] * 25
    ends = [float(rows[k]["temperature_C"]) for k in (0, 24, 25, 49)]
    assert ends == pytest.approx([60, 70, 40, 30])
    assert float(rows[24]["beta"]) == pytest.approx(75 / 28 * float(rows[0]["beta"]))
    there = [float(row["height_mm"]) for row in rows[:25]]
    back = [float(row["height_mm"]) for row in rows[25:]]
    assert back == pytest.approx(there[::-1], rel=2e-4)
    wide = float(rows[0]["width_mm"]) - float(rows[0]["depth_mm"])
    assert wide == pytest.approx(float(rows[0]["pitch_mm"]))


def test_the_small_array_of_the_paper_lifts_what_it_lifted(solved):
    """It weighed 3.9 g, thread and crimps included, and carried 40 g, hot and cold."""
    spec = load_specification(EXAMPLES / "small-array.toml", {"actuation.load_g": 40.0})
    data = actuation_data(actuate(spec, solved=solved))
    assert data["array"]["mass_g"] == pytest.approx(3.9, rel=0.05)
    assert data["load"]["load_over_mass"] > 10
    assert data["load"]["flattening_load_hot_g"] > 40
    assert data["load"]["height_hot_mm"] < 0.6 * data["load"]["height_cold_mm"]


def test_balance_work_and_ratios(lifting):
    data = actuation_data(lifting)
    heat, load, power, stroke = (data[key] for key in ("heat", "load", "power", "stroke"))
    assert heat["balance_error"] < 1e-6
    assert heat["joule_J"] == pytest.approx(heat["loss_J"] + heat["stored_J"], rel=1e-6)
    lifted_mm = stroke["last_cycle_stroke_mm"]
    assert load["work_per_cycle_mJ"] == pytest.approx(2e-3 * 9.80665 * lifted_mm, rel=1e-6)
    assert power["work_over_energy"] == pytest.approx(
        load["work_per_cycle_mJ"] / 1e3 / power["energy_per_cycle_J"]
    )
    cold, hot = stroke["height_cold_mm"], stroke["height_hot_mm"]
    assert stroke["stroke_over_height"] == pytest.approx((cold - hot) / cold)
    assert hot < load["height_hot_mm"] + 0.5 < load["height_cold_mm"] < cold
    array, resistance = data["array"], data["wire"]["resistance_ohm_m_hot"]
    assert array["resistance_ohm_hot"] == pytest.approx(
        resistance * array["wire_length_mm"] / 1e3, rel=1e-9
    )
    assert power["power_hot_W"] == pytest.approx(0.36 * array["resistance_ohm_hot"])
    assert array["mass_g"] == pytest.approx(array["wire_g"] + array["fabric_g"])
    assert data["warnings"] == []


def test_time_to_90_percent_is_that_of_the_curve(lifting):
    course, heights = lifting.history.course, lifting.working_mm
    cold, hot = lifting.height_mm(0.0), lifting.height_mm(1.0)
    found = actuation_data(lifting)["stroke"]["time_to_90_percent_s"]
    near = np.interp(found, course.time_s[:101], heights[:101])
    assert near == pytest.approx(cold + 0.9 * (hot - cold), abs=0.02 * (cold - hot))


def test_without_current_nothing_happens(made_of):
    data = actuation_data(made_of(current_A=0.0, load_g=2.0))
    assert data["heat"]["highest_C"] == 25
    assert data["stroke"]["last_cycle_stroke_mm"] == 0
    assert data["stroke"]["time_to_90_percent_s"] is None
    assert data["power"]["energy_per_cycle_J"] == 0
    assert data["power"]["work_over_energy"] is None
    assert any("does not transform" in warning for warning in data["warnings"])


def test_any_load_is_carried_or_flattens(made_of):
    data = actuation_data(made_of(load_g=1e9))
    assert data["load"]["flattened_at"]["time_s"] == 0
    assert (data["load"]["height_cold_mm"], data["load"]["work_per_cycle_mJ"]) == (0, 0)
    assert any("flattens the array" in warning for warning in data["warnings"])
    between = (data["load"]["flattening_load_cold_g"] + data["load"]["flattening_load_hot_g"]) / 2
    snapped = made_of(load_g=between)
    heights, place = snapped.loaded
    found = actuation_data(snapped)["load"]
    assert 60 < found["flattens_when_heated_to_C"] <= found["flattened_at"]["temperature_C"] < 70
    assert data["load"]["flattens_when_heated_to_C"] is None
    assert heights[:place].min() > 1
    assert heights[place:].max() == 0


@pytest.mark.parametrize("ambient_C", [-50.0, 300.0])
def test_cold_and_hot_rooms(made_of, ambient_C):
    data = actuation_data(made_of(ambient_C=ambient_C))
    assert data["heat"]["highest_C"] > ambient_C
    assert data["heat"]["balance_error"] < 1e-6
    stays = any("stays hot" in warning for warning in data["warnings"])
    assert stays == (ambient_C == 300.0)
    assert any("hot before" in warning for warning in data["warnings"]) == stays


def test_softer_when_hot_it_rises():
    data = actuation_data(actuate(spec_of({"modulus_hot_GPa": 22.0}, cooling_s=60.0)))
    assert data["stroke"]["stroke_mm"] < 0
    assert data["stroke"]["last_cycle_stroke_mm"] == pytest.approx(
        -data["stroke"]["stroke_mm"], rel=0.02
    )
    assert data["load"]["flattening_load_hot_g"] > data["load"]["flattening_load_cold_g"]


def test_a_hot_array_that_is_flat_tells_where_it_turns_flat():
    data = actuation_data(actuate(spec_of({"modulus_hot_GPa": 150.0})))
    heating, cooling = data["path"]["events"]
    assert (heating["kind"], cooling["kind"]) == ("turns flat", "rises")
    assert 60 < heating["temperature_C"] < 70
    assert 30 < cooling["temperature_C"] < 40
    assert data["stroke"]["height_hot_mm"] == 0
    assert data["load"]["flattening_load_hot_g"] == 0


def test_wire_that_turns_back_below_room_temperature_stays_hot(made_of):
    spec = load_specification(EXAMPLES / "large-array.toml")
    assert transformation(spec).temperatures_C == pytest.approx((40, 50, 20, 10))
    data = actuation_data(made_of(hysteresis_C=50.0))
    assert any("stays hot" in warning for warning in data["warnings"])
    assert data["stroke"]["time_back_50_percent_s"] is None


def test_a_solved_cell_of_another_is_refused(made_of):
    with pytest.raises(InputError, match="another one's"):
        made_of(wire={"diameter_mm": 0.31})


def test_thread_that_would_melt_is_told(made_of):
    data = actuation_data(made_of(current_A=1.2))
    assert any("polyester thread melts" in warning for warning in data["warnings"])


@pytest.fixture
def pair(tmp_path):
    path = tmp_path / "pair.toml"
    path.write_text(specification_from(SMALL, "pair").to_toml())
    return str(path)


@pytest.mark.parametrize(
    ("options", "fault"),
    [
        (["--current", "100A"], "current_A = 100: the wire would melt, at 1300 C, after 0.0"),
        (["--current", "-1A"], "--current: -1 A must be at least 0"),
        (["--current", "nan"], "--current: 'nan' is not a current"),
        (["--load", "inf"], "--load: 'inf' is not a mass: write 40g"),
        (["--load", "-3g"], "actuation.load_g = -3"),
        (["--ambient", "900C"], "actuation.ambient_C = 900"),
        (["--calibrate", "1A,3s"], "--calibrate: '1A,3s' must be current, time and temperature"),
        (["--calibrate", "0.6A,1s,900C"], "--calibrate: temperature_C = 900"),
        (["--calibrate", "0.6A,1s,5mm"], "--calibrate: '5mm' is not a temperature"),
    ],
)
def test_input_that_cannot_be(faults_of_command, pair, tmp_path, options, fault):
    target = tmp_path / "out"
    (said,) = faults_of_command(["actuate", pair, *options, "-o", str(target)])
    assert fault in said
    assert not target.exists()


def test_calibration_gives_the_convection_that_explains_the_measurement(run_command, pair):
    arguments = ["actuate", pair, "--calibrate", "0.6A,30s,95C", "--json", "-o", f"{pair}.out"]
    code, out, err = run_command(arguments)
    assert code == 0, err
    data = json.loads(out)
    assert data["surroundings"]["convection_from"] == "specification"
    found = data["specification"]["actuation"]["convection_W_m2K"]
    assert found == data["surroundings"]["convection_W_m2K"]
    table = Path(f"{pair}.out", "curves", "time.csv").read_text()
    rows = list(csv.DictReader(table.splitlines()))
    assert float(rows[100]["temperature_C"]) == pytest.approx(95, abs=1e-6)


def test_a_narrow_hysteresis_is_refused_by_its_keys(faults_of_command, tmp_path):
    path = tmp_path / "pair.toml"
    heat = {"hysteresis_C": 1.0, "cooling_span_C": 40.0}
    path.write_text(specification_from(SMALL | {"actuation": heat}, "pair").to_toml())
    (said,) = faults_of_command(["actuate", str(path), "-o", str(tmp_path / "out")])
    assert "actuation.hysteresis_C = 1: must be at least 15" in said
