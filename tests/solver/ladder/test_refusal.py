"""What a refusal on the mesh says would help."""

from solver.ladder.contact import WITHOUT
from solver.ladder.refusal import refused
from solver.mesh.circle_sheet import circle_scene
from solver.scene import LoopScene

LOOP = LoopScene(0.3, 0.0145, 0.3)


def test_a_remedy_is_named_once():
    assert WITHOUT in str(refused("not settled", [], LOOP))
    assert str(refused(f"not settled; {WITHOUT}", [], LOOP)).count(WITHOUT) == 1
    # designs have no option to leave contact out
    sheet = circle_scene(LOOP, ((0, 0),), (1.0,), ())
    assert str(refused("not settled", [], sheet)) == "not settled"
