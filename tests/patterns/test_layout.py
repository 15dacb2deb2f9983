import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from patterns.errors import PatternError
from patterns.layout import tangent_layout
from patterns.loop import Loop


def test_contact_of_unequal_loops_divides_the_line_of_centres_by_the_radii():
    layout = tangent_layout((Loop(0, 0, 30), Loop(0, 20, 10)))
    (contact,) = layout.contacts
    assert (contact.first, contact.second) == (0, 1)
    assert (contact.x_mm, contact.y_mm) == pytest.approx((0, 15))


def test_loops_with_a_gap_do_not_touch():
    assert tangent_layout((Loop(0, 0, 10), Loop(10.001, 0, 10))).contacts == ()


def test_overlap_names_the_loops_and_their_distance():
    with pytest.raises(PatternError, match=r"loops 1 and 3 overlap: .* 9\.5 mm apart"):
        tangent_layout((Loop(-10, 0, 10), Loop(0, 0, 10), Loop(40, 0, 10), Loop(9.5, 0, 10)))


def test_a_loop_inside_another_overlaps_it():
    with pytest.raises(PatternError, match="overlap"):
        tangent_layout((Loop(0, 0, 50), Loop(1, 2, 5)))


def test_nothing_is_a_layout_without_contacts():
    assert tangent_layout(()).contacts == ()


@settings(deadline=None, max_examples=30)
@given(st.lists(st.tuples(st.integers(0, 5), st.integers(0, 5)), unique=True, max_size=20))
def test_contacts_are_those_of_comparing_every_pair(cells):
    layout = tangent_layout(tuple(Loop(10.0 * x, 10.0 * y, 10.0) for x, y in cells))
    found = [(c.first, c.second) for c in layout.contacts]
    assert found == [
        (i, j)
        for i, a in enumerate(cells)
        for j, b in enumerate(cells)
        if i < j and np.hypot(a[0] - b[0], a[1] - b[1]) == 1
    ]
