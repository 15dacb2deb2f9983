import numpy as np
import pytest

from patterns.errors import PatternError
from patterns.laid_wire import laid_wire
from patterns.path import Line, WirePath
from patterns.ties import tie_runs

WIRE = laid_wire(WirePath((Line(-20, 0, 20, 0),)))
SIZES = {"length_mm": 2.0, "clear_mm": 0.6, "lock_length_mm": 0.7}


def ties(middle, along, **changes):
    return tie_runs(np.array(middle), np.array(along), WIRE, **{**SIZES, **changes})


def test_a_tie_goes_thrice_between_two_holes_and_is_locked_inside():
    (run,) = ties([[3.0, 5.0]], [[0.0, 4.0]])
    assert run[:, 0] == pytest.approx(np.full(8, 3.0))
    assert run[:, 1] == pytest.approx([4, 4.7, 4, 6, 4, 6, 5.3, 6])


def test_ties_lie_where_and_as_they_are_asked_for():
    runs = ties([[0.0, 5.0], [9.0, -2.0]], [[1.0, 1.0], [1.0, 0.0]])
    assert [run.mean(axis=0).tolist() for run in runs] == [
        pytest.approx([0, 5]),
        pytest.approx([9, -2]),
    ]
    assert np.ptp(runs[0][:, 0]) == pytest.approx(np.sqrt(2))


def test_no_tie_brings_the_needle_to_a_wire():
    ties([[0.0, 0.6]], [[1.0, 0.0]])
    with pytest.raises(PatternError, match=r"tie at \(4\.00, 1\.50\) mm .* within 0\.50 mm"):
        ties([[0.0, 9.0], [4.0, 1.5]], [[1.0, 0.0], [0.0, 1.0]])


@pytest.mark.parametrize(
    ("along", "changes", "said"),
    [([[1.0, 0.0]], {"length_mm": 1.3}, "no room"), ([[0.0, 0.0]], {}, "no direction")],
)
def test_a_tie_that_cannot_be_is_refused(along, changes, said):
    with pytest.raises(PatternError, match=said):
        ties([[0.0, 9.0]], along, **changes)
