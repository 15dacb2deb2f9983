from itertools import takewhile

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import fsolve, minimize_scalar

from solver.strip.balance import at_couple
from solver.strip.basis import strip_basis
from solver.strip.elastica import Elastica
from solver.strip.ends import Ends, second_clamped_load
from solver.strip.path import carried, stable_branch, steps_along
from solver.strip.phase import at_rest, first_state

HALF = (0.0, 0.5)


def _started(shortening, ends=Ends.PINNED, covered=HALF, degree=24):
    balance = at_rest(strip_basis(covered, ends, degree), shortening)
    return balance, first_state(balance, ends)


def _critical(shortening, ends=Ends.PINNED, covered=HALF, degree=24, sign=1):
    return stable_branch(*_started(shortening, ends, covered, degree), sign, 40.0).end.couple


def _shot(shortening, force, guess):
    """Heading at the start and couple of a pinned strip of a force, by shooting."""

    def slopes(s, y, couple):
        theta, moment = y[0], y[1]
        curvature = moment + couple
        return [curvature, -force * np.sin(theta), np.cos(theta), np.sin(theta)]

    def missing(unknown):
        y = [unknown[0], 0.0, 0.0, 0.0]
        for span, couple in (((0, 0.5), unknown[1]), ((0.5, 1), 0.0)):
            run = solve_ivp(
                slopes, span, y, args=(couple,), method="DOP853", rtol=1e-11, atol=1e-12
            )
            y = run.y[:, -1]
        return [y[2] - (1 - shortening), y[3]]

    return fsolve(missing, guess, xtol=1e-11)


@pytest.mark.parametrize("shortening", [0.05, 0.5])
def test_the_critical_couple_by_shooting(shortening):
    """The largest couple of all strips in balance, without any basis."""
    balance, state = _started(shortening)
    end = stable_branch(balance, state, 1, 40.0).end
    guess = [(balance.basis.headings_at(np.zeros(1)) @ end.x)[0], end.couple]
    near = end.force[0]
    best = minimize_scalar(
        lambda force: -_shot(shortening, force, guess)[1],
        bounds=(0.99 * near, 1.01 * near),
        method="bounded",
        options={"xatol": 1e-3 * near},
    )
    assert end.couple == pytest.approx(-best.fun, rel=1e-6)


def _linear_couple(force):
    """Couple over √δ at which a nearly straight strip, pinned, half covered, bears a force.

    From μ'' + P μ = −P κ0 with μ = 0 at the ends, and δ = ½ ∫ θ² with θ = −μ'/P.
    """
    beta = np.sqrt(force)
    h = beta / 2
    b, c = (np.tan(h) + np.tan(h / 2)) / 2, (np.tan(h) - np.tan(h / 2)) / 2

    def heading(s):
        slope = -np.sin(beta * s) + b * np.cos(beta * s) if s < 0.5 else -c * np.cos(beta * (1 - s))
        return -slope / beta

    return 1 / np.sqrt(quad(lambda s: heading(s) ** 2 / 2, 0, 1, points=[0.5])[0])


def test_the_critical_couple_of_the_nearly_straight_strip():
    most = minimize_scalar(
        lambda force: -_linear_couple(force), bounds=(1.2 * np.pi**2, 3.5 * np.pi**2)
    )
    assert -most.fun == pytest.approx(7.0627, abs=1e-4)
    off = [_critical(d) / np.sqrt(d) / -most.fun - 1 for d in (1e-8, 1e-3, 1e-2)]
    assert abs(off[0]) < 1e-7
    assert off[2] / off[1] == pytest.approx(10, rel=0.02)


@pytest.mark.parametrize(("ends", "sign"), [(Ends.PINNED, 1), (Ends.CLAMPED, -1)])
@pytest.mark.parametrize("covered", [HALF, (0.05, 0.45)])
def test_more_polynomials_change_nothing(ends, sign, covered):
    coarse, fine = (_critical(0.5, ends, covered, degree, sign) for degree in (24, 36))
    assert coarse == pytest.approx(fine, rel=1e-9)


def test_around_the_fold_lies_the_second_mode():
    """The path of state + turns back at the fold and ends, without couple, in the saddle."""
    balance, state = _started(0.2)
    walked = list(takewhile(lambda step: step.end.couple > 0, steps_along(balance, state, 1)))
    saddle = at_couple(balance, walked[-1].end, 0.0)
    assert balance.energy(saddle.x, 0.0) == pytest.approx(Elastica(0.2, 2).energy, rel=1e-10)


def test_the_couple_falls_as_a_root_beyond_the_fold():
    """The lowest eigenvalue vanishes with the root of what is missing to the critical couple."""
    balance, state = _started(0.2)
    branch = stable_branch(balance, state, 1, 40.0)
    values = [
        balance.lowest_eigenvalue(branch.at(branch.end.couple * (1 - d))) for d in (4e-4, 1e-4)
    ]
    assert values[0] / values[1] == pytest.approx(2, rel=0.01)


def test_states_at_a_couple():
    balance, state = _started(0.2)
    branch = stable_branch(balance, state, 1, 40.0)
    assert branch.at(1.0).couple == pytest.approx(1.0, rel=1e-9)
    assert branch.at(1.23).couple == pytest.approx(1.23, rel=1e-9)
    assert branch.at(1.0).x == pytest.approx(at_couple(balance, state, 1.0).x, abs=1e-9)
    assert branch.at(1.01 * branch.end.couple) is None
    assert carried(balance, state, 1.01 * branch.end.couple) is None
    nearly = carried(balance, state, (1 - 1e-7) * branch.end.couple)
    assert nearly.couple == pytest.approx((1 - 1e-7) * branch.end.couple, rel=1e-12)
    assert carried(balance, state, 1.0).x == pytest.approx(branch.at(1.0).x, abs=1e-9)


def test_clamped_states_merge():
    """A couple on exactly half of a nearly straight clamped strip drives its second mode alone.

    With a force of 4π² this takes up all of δ at the couple at which the states merge: by the
    linear theory of the strip, θ'' + P θ constant, θ = 0 at the ends and θ' with a jump in between.
    """
    balance, state = _started(1e-6, Ends.CLAMPED)
    branch = stable_branch(balance, state, 1, 0.1)
    assert branch.merges
    beta = 2 * np.pi
    # on the left half, θ = a (1 − cos βs) + b sin βs with θ' = −1/2 at its end; its mean is 0
    b = 1 / (2 * beta)
    a = -b * (1 - np.cos(beta / 2)) / (beta / 2)
    square = quad(lambda s: (a * (1 - np.cos(beta * s)) + b * np.sin(beta * s)) ** 2, 0, 0.5)[0]
    assert branch.end.couple / 1e-3 == pytest.approx(1 / np.sqrt(square), rel=1e-5)
    assert branch.end.force[0] == pytest.approx(4 * np.pi**2, rel=1e-4)
    assert 4 * np.pi**2 < second_clamped_load() ** 2
