"""The paper's six beams, from their specification to the numbers in `design.json`."""

import json

import pytest

from sesame_cad.errors import InputError
from sesame_cad.sleeve_prediction.data import bistable_data, sleeve_data
from sesame_cad.sleeve_prediction.segment import beam_segment, predict_sleeve
from sesame_cad.specification import Specification


def _with(spec, section, **keys):
    data = spec.model_dump()
    data[section] |= keys
    return Specification.model_validate(data)


def test_sizes_become_si_units(spec):
    segment, beam = beam_segment(spec), spec.beam
    hole = 2 * beam.hole_diameter_mm
    assert segment.strip.length_m == pytest.approx((beam.length_mm - 2 * hole) / 1e3)
    assert segment.strip.constraint_m == pytest.approx((beam.constraint_length_mm - 2 * hole) / 1e3)
    assert segment.strip.thickness_m == pytest.approx(0.38e-3)
    assert segment.pitch_m == pytest.approx(spec.compressed_pitch_mm / 1e3)
    assert segment.cell.stripe_m == pytest.approx(0.035)
    assert segment.loops == 4
    begin, end = (share * segment.strip.length_m * 1e3 for share in segment.strip.covered)
    assert begin + hole == pytest.approx(spec.sleeve_place.start_mm)
    assert end + hole == pytest.approx(spec.sleeve_place.end_mm)


def test_sleeves_on_the_right_half_are_the_mirror_image(spec):
    left = beam_segment(spec).strip.covered
    right = beam_segment(_with(spec, "sleeve", half="right")).strip.covered
    assert right == pytest.approx((1 - left[1], 1 - left[0]))


def test_other_layouts_are_refused():
    wire, layout = {"diameter_mm": 0.5}, {"rows": 1, "columns": 2, "loop_diameter_mm": 50}
    grid = Specification.model_validate({"name": "plain", "wire": wire, "layout": layout})
    with pytest.raises(InputError, match=r'plain: layout.kind = "grid": must be "sleeve"'):
        predict_sleeve(grid)


def test_a_sleeve_that_stays_loose_is_refused(spec):
    loose = _with(spec, "layout", columns=2)
    with pytest.raises(InputError, match=r"beam-sleeves: the sleeve is not compressed: 2 loops"):
        predict_sleeve(loose)


def test_the_example_snaps(prediction):
    data = bistable_data(prediction)
    assert data["snaps"] is True
    critical = data["critical_couple_Nmm"]
    net = sleeve_data(prediction)["net_moment_Nmm"]
    assert data["margin"] == pytest.approx(net / critical, rel=1e-9)
    assert data["barrier_mJ"] > data["states"][0]["energy_mJ"] > 0
    up, down = data["states"]
    assert (up["state"], down["state"]) == ("+", "-")
    assert (up["snaps_when_heated"], down["snaps_when_heated"]) == ("lower", "upper")
    assert up["height_mm"] == pytest.approx(-down["height_mm"], rel=1e-9)
    assert min(up["lowest_eigenvalue_mJ"], down["lowest_eigenvalue_mJ"]) > 0


def test_moments_are_force_times_arm(prediction):
    data = sleeve_data(prediction)
    for state in ("cold", "hot"):
        moment = data["force_N"][state] * data["arm_mm"][state]
        assert data["moment_Nmm"][state] == pytest.approx(moment)
    net = data["moment_Nmm"]["hot"] - data["moment_Nmm"]["cold"]
    assert data["net_moment_Nmm"] == pytest.approx(net)
    assert data["compressed_pitch_mm"] < data["free_pitch_mm"]


def test_both_blocks_are_plain_data(prediction):
    both = [sleeve_data(prediction), bistable_data(prediction)]
    assert json.loads(json.dumps(both, allow_nan=False)) == both
    terms = [term["term"] for term in both[0]["omitted_terms"]]
    assert "twist and bending sideways" in terms
    assert "bending across the width" in terms
    assert len(set(terms)) == len(terms)
