import json
from xml.etree import ElementTree

import numpy as np
import pytest
from click.testing import CliRunner

from sesame_cad.cli import cli
from sesame_cad.errors import InputError
from sesame_cad.files.chain_svg import chain_svg
from sesame_cad.sleeve_prediction.chain import ChainCurve, chain_csv, chain_curve, chain_json
from solver.strip.chain import chain


@pytest.fixture(scope="module")
def curve(prediction):
    return ChainCurve("++-", 1e3 * chain("++-", prediction.rest.unloaded))


def test_rivets_are_a_chord_apart(prediction, curve):
    apart = np.linalg.norm(np.diff(curve.rivets_mm, axis=0), axis=1)
    assert apart == pytest.approx(prediction.segment.strip.constraint_m * 1e3, rel=1e-9)
    assert len(curve.rivets_mm) == 4


def test_equal_states_turn_by_the_difference_of_the_end_angles(prediction):
    state = prediction.rest.unloaded
    up = next(iter(state.values()))
    turn = np.rad2deg(up.headings_rad[-1] - up.headings_rad[0])
    made = ChainCurve("+++", 1e3 * chain("+++", state))
    assert made.turn_deg == pytest.approx(2 * turn, rel=1e-9)
    many = ChainCurve("+" * 12, 1e3 * chain("+" * 12, state))
    assert many.turn_deg == pytest.approx(11 * turn, rel=1e-9)
    assert abs(many.turn_deg) > 360


def test_files_hold_the_same_points(curve):
    rows = [line.split(",") for line in chain_csv(curve).splitlines()[1:]]
    points = np.array([[float(x), float(y)] for *_, x, y in rows])
    assert points == pytest.approx(curve.segments_mm.reshape(-1, 2), abs=1e-4)
    assert [row[1] for row in rows[:: curve.segments_mm.shape[1]]] == list("++-")
    data = json.loads(chain_json(curve))
    assert np.array(data["rivets_mm"]) == pytest.approx(curve.rivets_mm, abs=1e-4)


def test_the_drawing_is_true_to_size(curve):
    root = ElementTree.fromstring(chain_svg(curve, "a chain"))
    layers = {group.get("id"): group for group in root.iter("{http://www.w3.org/2000/svg}g")}
    assert len(layers["PLUS"]) == 2
    assert len(layers["MINUS"]) == 1
    path = layers["MINUS"][0].get("d").removeprefix("M ").split(" L ")
    drawn = np.array([[float(v) for v in pair.split(",")] for pair in path])
    along = np.linalg.norm(drawn[-1] - drawn[0])
    assert along == pytest.approx(np.linalg.norm(np.diff(curve.rivets_mm, axis=0)[2]), abs=2e-3)
    assert root.get("width") == f"{root.get('viewBox').split()[2]}mm"


@pytest.mark.parametrize("states", ["", "+x", "+ -", "+" * 1001])
def test_other_signs_are_refused(spec, states):
    with pytest.raises(InputError, match=r"must be 1 to 1000 signs, each [+] or -"):
        chain_curve(spec, states)


def test_the_command_writes_a_file_once(tmp_path, spec, curve, monkeypatch):
    monkeypatch.setattr(
        "sesame_cad.sleeve_prediction.chain.chain_curve", lambda _spec, _states: curve
    )
    target = tmp_path / "chain.csv"
    path = tmp_path / "spec.toml"
    path.write_text(spec.to_toml())
    words = ["chain", str(path), "--states", "-+", "-o", str(target)]
    done = CliRunner().invoke(cli, words)
    assert done.exit_code == 0, done.output
    assert target.read_text() == chain_csv(curve)
    again = CliRunner().invoke(cli, words)
    assert again.exit_code != 0
    assert target.read_text() == chain_csv(curve)


def test_other_kinds_of_file_are_refused(tmp_path):
    words = ["chain", str(tmp_path / "no.toml"), "--states", "+", "-o", "chain.pdf"]
    done = CliRunner().invoke(cli, words)
    assert isinstance(done.exception, InputError)
    assert "must end in .svg, .csv, .json" in str(done.exception)
