import numpy as np
import pytest

from sesame_cad.sleeve_prediction.curves import force_curve_csv, force_curves


@pytest.fixture(scope="module")
def curves(prediction):
    return force_curves(prediction)


def test_curves_end_where_the_free_sleeve_stands(prediction, curves):
    assert curves[0].pitch_mm[-1] == pytest.approx(prediction.free_pitch_m * 1e3)
    for curve in curves:
        assert abs(curve.force_N[-1]) < 1e-3
        assert np.all(np.diff(curve.pitch_mm) > 0)
        assert np.all(np.diff(curve.force_N) < 0)


def test_curves_run_through_the_compressed_sleeve(prediction, curves):
    pitch_mm = prediction.segment.pitch_m * 1e3
    for curve, couple in zip(curves, (prediction.cold, prediction.hot), strict=True):
        force = np.interp(pitch_mm, curve.pitch_mm, curve.force_N)
        assert force == pytest.approx(couple.force_N, rel=5e-3)


def test_a_line_a_pitch(curves):
    lines = force_curve_csv(curves).splitlines()
    assert lines[0].split(",")[:3] == ["temperature", "pitch_mm", "force_N"]
    assert len(lines) == 1 + sum(len(curve.pitch_mm) for curve in curves)
    assert not any("-0.0000" in line for line in lines)
    last = lines[-1].split(",")
    assert (last[0], float(last[1])) == ("hot", pytest.approx(curves[1].pitch_mm[-1], abs=1e-4))
