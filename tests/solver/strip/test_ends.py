import numpy as np
import pytest

from solver.strip.ends import Ends, buckling_headings, buckling_loads

ARC, WEIGHT = np.polynomial.legendre.leggauss(60)
ARC, WEIGHT = (ARC + 1) / 2, WEIGHT / 2


@pytest.mark.parametrize("ends", list(Ends))
def test_headings_are_orthonormal_and_keep_the_chord_level(ends):
    modes = np.array(buckling_headings(ends, ARC))
    assert (WEIGHT * modes) @ modes.T == pytest.approx(np.eye(2), abs=1e-12)
    assert modes @ WEIGHT == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("ends", list(Ends))
def test_loads_are_the_energies_of_the_headings(ends):
    step = 1e-5
    pairs = zip(
        buckling_headings(ends, ARC + step), buckling_headings(ends, ARC - step), strict=True
    )
    for load, (after, before) in zip(buckling_loads(ends), pairs, strict=True):
        assert WEIGHT @ ((after - before) / (2 * step)) ** 2 == pytest.approx(load, rel=1e-8)


def test_clamped_loads():
    first, second = buckling_loads(Ends.CLAMPED)
    assert first / np.pi**2 == pytest.approx(4)
    assert second / np.pi**2 == pytest.approx(8.1830, abs=1e-4)
