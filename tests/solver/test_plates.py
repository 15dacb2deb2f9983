import math

import pytest

from solver.errors import SceneError
from solver.plates import Pitch, PlateAxis, Plates


@pytest.mark.parametrize("gap", [0.0, -1.0, math.nan, math.inf])
def test_a_gap_without_room_is_refused(gap):
    with pytest.raises(SceneError, match=r"gap = .*greater than the wire's diameter"):
        Plates(gap)


def test_the_wire_itself_takes_room():
    with pytest.raises(SceneError, match=r"gap = 0\.02.*0\.02"):
        Plates(0.02, PlateAxis.HEIGHT, wire_diameter=0.02)
    plates = Plates(1.0, wire_diameter=0.02)
    assert plates.wire_reach == 0.49
    assert plates.fabric_reach == 0.5


@pytest.mark.parametrize("diameter", [-0.1, math.nan, math.inf])
def test_a_wire_has_a_diameter(diameter):
    with pytest.raises(SceneError, match="wire_diameter"):
        Plates(1.0, wire_diameter=diameter)


def test_a_pitch_is_no_longer_than_the_wire_allows():
    for pitch, width in ((0.0, None), (4.0, None), (1.0, -1.0), (math.nan, None)):
        with pytest.raises(SceneError, match="half of the wire's length"):
            Pitch(pitch, width)
