import numpy as np
from shapely import box

from patterns.laid_wire import laid_wire
from patterns.path import Line, WirePath
from patterns.placement import ARM_MM, CLEAR_MM, GAP_MM, corner_marks, end_marks

FAR = laid_wire(WirePath((Line(500, 500, 600, 500),)))


def test_a_piece_gets_an_angle_outside_of_each_corner():
    marks = corner_marks([box(-50, -30, 50, 30)], FAR)
    places = {(mark.x_mm, mark.y_mm) for mark in marks}
    assert places == {(x * (50 + GAP_MM), y * (30 + GAP_MM)) for x in (-1, 1) for y in (-1, 1)}
    for mark in marks:
        (stroke,) = mark.strokes
        assert np.allclose(np.hypot(*np.diff(stroke, axis=0).T), ARM_MM)
        assert np.all((abs(stroke[:, 0]) >= 50 - ARM_MM) & (abs(stroke[:, 1]) >= 30 - ARM_MM))
        assert box(-50, -30, 50, 30).distance(box(*stroke[1], *stroke[1])) > GAP_MM


def test_a_mark_that_meets_wire_is_left_out():
    near = laid_wire(WirePath((Line(-60, 31 + CLEAR_MM / 2, -40, 31 + CLEAR_MM / 2),)))
    marks = corner_marks([box(-50, -30, 50, 30)], near)
    assert (-51.0, 31.0) not in {(mark.x_mm, mark.y_mm) for mark in marks}
    assert len(marks) == 3


def test_a_beam_gets_a_line_beyond_both_ends_across_its_axis():
    left, right = end_marks([box(-50, 20, 50, 30)], FAR)
    assert (left.x_mm, right.x_mm) == (-50 - GAP_MM, 50 + GAP_MM)
    assert left.strokes[0].tolist() == [[-51, 25 - ARM_MM / 2], [-51, 25 + ARM_MM / 2]]
