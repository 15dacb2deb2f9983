"""Minimisation with sparse second derivatives in a trust region.

The true Hessian is tried first. Where its factorisation shows negative pivots, the convex part of
the elements' Hessians takes over as the metric, and the true Hessian still shapes the step: it
leaves saddle points along their negative directions. Of wrinkled fabric a slightly stiffer Hessian
is tried before: what the convex part leaves out matters more there.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from solver.mesh.correction import Move, corrected
from solver.mesh.elements import Curvature
from solver.mesh.factorization import Factored, Factoriser
from solver.mesh.krylov import Product, QuadraticModel, Step, symmetric_product, trust_region_step
from solver.mesh.mesh_energy import Energy
from solver.mesh.search import SearchLimits, SparseMinimum

Vectors = NDArray[np.float64]

_FREE_MOTION = 1e-5
"""Stiffness, in units of E_f t, lent to motions that have none, such as rigid ones."""
_CONVEX_FREE_MOTION = 1e-4
_LENT = (0.03, 0.3, 3.0)
"""Stiffness, in units of E_f t, that makes a Hessian with negative eigenvalues a metric; the first
that is enough. All but a few of its eigenvalues are the Hessian's own: few iterations solve it."""
_ROUNDING = 1e-13
_NEXT_TO_NOTHING = 1e-10
"""Part of the energy that a minimum may lack along an all but free motion."""
_STALLED_STEPS = 10
"""Steps in a row that gain so little together where fabric is wrinkled, or mere rounding."""
_ALL_BUT_FREE = 1e-3
"""Largest stiffness of such a motion, in units of E_f t."""
_SMALL_GRADIENT = 1e-4
"""Largest component of the gradient while it lasts."""
_GOOD_RATIO = 0.75
"""Of what a step brings to what the model promised, for the model to be trusted further."""
_SMALLEST_RADIUS = 1e-12
_TINY = 1e-300
_LONGEST_MOVE = 0.5
"""Of any vertex in one step, in units of R."""


@dataclass
class _Account:
    """What a search has spent, and the energy at each shape on its way."""

    steps: int = 0
    factorizations: int = 0
    values: list[float] = field(default_factory=list[float])


@dataclass(frozen=True)
class _State:
    """Energy and its derivatives at a shape."""

    positions: Vectors
    value: float
    gradient: Vectors
    entries: Vectors

    @property
    def gradient_norm(self) -> float:
        return float(np.abs(self.gradient).max())


@dataclass(frozen=True)
class _Search:
    energy: Energy
    mass: Vectors
    factoriser: Factoriser
    limits: SearchLimits
    account: _Account

    def state(self, positions: Vectors) -> _State:
        curvature = Curvature.STEADY if self.limits.steady else Curvature.TRUE
        return _State(positions, *self.energy.derivatives(positions, curvature))

    def true_state(self, state: _State) -> _State:
        """Give the same with its true Hessian."""
        return _State(state.positions, *self.energy.derivatives(state.positions))

    def held(self, entries: Vectors, stiffness: float) -> Vectors:
        """Lend every motion a little stiffness, more than the rounding of the entries."""
        diagonal = self.energy.pattern.diagonal
        rounding = _ROUNDING * float(np.linalg.norm(entries[diagonal]))
        out = entries.copy()
        out[diagonal] += max(stiffness, rounding) * self.mass
        return out

    def factored(self, entries: Vectors) -> Factored:
        self.account.factorizations += 1
        return self.factoriser.factorise(entries)

    def model(self, state: _State, true_entries: Vectors, factored: Factored) -> QuadraticModel:
        pattern = self.energy.pattern
        hessian = symmetric_product(pattern, true_entries)
        gradient = state.gradient.ravel()
        if factored.negative == 0:
            return QuadraticModel(gradient, hessian, hessian, factored.solve, convex=True)
        entries, inverse = self.metric(state, true_entries)
        metric = symmetric_product(pattern, entries)
        return QuadraticModel(gradient, hessian, metric, inverse, convex=False)

    def metric(self, state: _State, true_entries: Vectors) -> tuple[Vectors, Product]:
        """Entries of a positive definite matrix near a Hessian that is not, and its inverse."""
        for lent in _LENT if self.limits.steady else ():
            entries = self.held(true_entries, lent)
            factored = self.factored(entries)
            if factored.negative == 0:
                return entries, factored.solve
        convex = self.energy.derivatives(state.positions, Curvature.CONVEX)[2]
        entries = self.held(convex, _CONVEX_FREE_MOTION)
        return entries, self.factored(entries).solve


@dataclass(frozen=True)
class _Tried:
    """A trial of a step: where it led, and how that compares with the model's promise."""

    positions: Vectors
    accepted: bool
    radius: float


def _noise(value: float) -> float:
    return _ROUNDING * max(1.0, abs(value))


def _lengthened(
    energy: Energy, positions: Vectors, move: Vectors, value: float
) -> tuple[float, float]:
    """Double a step that went well for as long as the energy falls; its factor and the energy.

    In the curved valleys of a stiff wire the model promises less than it could.
    """
    factor = 1.0
    while 2 * factor * float(np.abs(move).max()) < _LONGEST_MOVE:
        further = energy.value(positions + 2 * factor * move)
        if not further < value:
            break
        factor, value = 2 * factor, further
    return factor, value


def _tried(
    search: _Search, state: _State, model: QuadraticModel, step: Step, radius: float
) -> _Tried:
    """Try a step and adapt the trust region's radius to what it brought."""
    move = step.displacement.reshape(-1, 3)
    move = move * min(1.0, _LONGEST_MOVE / max(float(np.abs(move).max()), 1e-300))
    promised = model.change(move.ravel())
    length = model.length(move.ravel())
    value = search.energy.value(state.positions + move)
    noise = _noise(state.value)
    if abs(promised) < 10 * noise:
        # below rounding the energy tells nothing: the step is taken on trust
        trusted = abs(value - state.value) < 100 * noise
        return _Tried(state.positions + move, trusted, 2 * radius if trusted else 0.25 * length)
    ratio = (value - state.value) / promised if promised < 0 else -1.0
    if not ratio > _GOOD_RATIO:
        straight = Move(move, value)
        bent = corrected(search.energy, model, state.positions, straight, state.value + promised)
        move, value = bent.displacement, bent.value
        ratio = (value - state.value) / promised if promised < 0 else -1.0
    if not ratio > 0.25:  # also when the energy is not a number
        return _Tried(state.positions + move, ratio > 1e-4, 0.25 * length)
    factor, value = _lengthened(search.energy, state.positions, move, value)
    if ratio > _GOOD_RATIO and (step.bounded or factor > 1):
        radius = max(radius, max(2.0, factor) * length)
    return _Tried(state.positions + factor * move, accepted=True, radius=radius)


def _free_to_drift(search: _Search, model: QuadraticModel) -> bool:
    """Whether all that is left is a motion that is all but free.

    Such is the turn of a round loop's fabric under its saddle: the gradient may take many steps
    along it to vanish while the energy no longer changes.
    """
    step = model.inverse(model.gradient)
    pull = float(model.gradient @ step)
    return pull <= _ALL_BUT_FREE * float(step @ (search.mass * step))


def _settled(search: _Search, state: _State, model: QuadraticModel) -> bool:
    """Whether the gradient is small for a shape that the model keeps, and the energy is down.

    Where wires are stiff a small gradient alone says little of soft motions, such as buckling at
    the threshold.
    """
    limits = search.limits
    if not model.convex or state.gradient_norm > max(_SMALL_GRADIENT, limits.gradient):
        return False
    gain = float(model.gradient @ model.inverse(model.gradient)) / 2
    if gain > max(_NEXT_TO_NOTHING * abs(state.value), _noise(state.value)):
        return False
    small = state.gradient_norm <= limits.gradient
    return small or limits.steady or _free_to_drift(search, model)


def _stalled(search: _Search, state: _State) -> bool:
    """Whether many steps in a row gain next to nothing.

    Those over the kinks of wrinkled fabric do; so do all where only rounding is left to gain, and
    there negative eigenvalues are rounding too: a bare wire that is free of stress has many motions
    without stiffness, which the slightest push in it makes unstable.
    """
    limits = search.limits
    if state.gradient_norm > (_SMALL_GRADIENT if limits.steady else limits.gradient):
        return False
    before = search.account.values[-1 - _STALLED_STEPS : -_STALLED_STEPS]
    little = limits.little * abs(state.value) if limits.steady else _noise(state.value)
    return bool(before) and before[0] - state.value <= little


def _at_rest(search: _Search, state: _State, model: QuadraticModel) -> bool:
    """Whether nothing pulls any more, and the model has no way down."""
    return _stalled(search, state) or _settled(search, state, model)


def _modelled(search: _Search, state: _State) -> tuple[QuadraticModel, Factored, Vectors]:
    """Model of the energy at a shape, with its factorised matrix and that matrix' entries."""
    entries = search.held(state.entries, _FREE_MOTION)
    factored = search.factored(entries)
    return search.model(state, entries, factored), factored, entries


def _stepped(search: _Search, state: _State, model: QuadraticModel, radius: float) -> _Tried:
    """Try steps until one is accepted; the last one is not when the limits end the search."""
    limits, account = search.limits, search.account
    while True:
        step = trust_region_step(model, radius)
        promised = -model.change(step.displacement)
        spent = account.steps >= limits.steps or radius < _SMALLEST_RADIUS
        if spent or promised < limits.decrease * abs(state.value):
            return _Tried(state.positions, accepted=False, radius=radius)
        account.steps += 1
        tried = _tried(search, state, model, step, radius)
        if tried.accepted:
            return tried
        radius = tried.radius


def _gained(search: _Search, state: _State, tried: _Tried) -> float:
    """Part of the energy that a way down gains; no way is infinite, for it has not been tried."""
    if not tried.accepted:
        return np.inf
    return (state.value - search.energy.value(tried.positions)) / max(abs(state.value), _TINY)


def _ended(
    search: _Search,
    state: _State,
    factored: Factored,
    *,
    converged: bool,
    way_down: float = 0.0,
) -> SparseMinimum:
    return SparseMinimum(
        positions=state.positions,
        value=state.value,
        gradient_norm=state.gradient_norm,
        entries=state.entries,
        factored=factored,
        negative=factored.negative,
        steps=search.account.steps,
        factorizations=search.account.factorizations,
        converged=converged,
        way_down=way_down,
        most_steps=search.limits.steps,
        way=tuple(search.account.values),
    )


def minimise_sparse(
    energy: Energy,
    positions: Vectors,
    mass: Vectors,
    factoriser: Factoriser,
    limits: SearchLimits | None = None,
) -> SparseMinimum:
    """Go downhill from positions (n, 3) to a minimum.

    Parameters
    ----------
    mass : array (n,)
        Weight of each vertex in the mean square of a displacement, greater than 0.
    factoriser : Factoriser
        For the energy's pattern.
    """
    limits = limits or SearchLimits()
    account = _Account(values=list(limits.before))
    search = _Search(energy, np.repeat(mass, 3), factoriser, limits, account)
    state = search.state(positions)
    radius = limits.radius
    while True:
        search.account.values.append(state.value)
        model, factored, _ = _modelled(search, state)
        at_rest = _at_rest(search, state, model)
        if at_rest and limits.steady:
            state = search.true_state(state)
            model, factored, entries = _modelled(search, state)
            if model.convex:
                return _ended(search, state, factored, converged=True)
            tried = _stepped(search, state, model, limits.radius)
            # kinks of the stiffness open ways that lead nowhere, a saddle point others
            gained = _gained(search, state, tried)
            if gained <= limits.little:
                again = search.factored(entries)
                return _ended(search, state, again, converged=True, way_down=max(0.0, gained))
        elif at_rest:
            return _ended(search, state, factored, converged=True)
        else:
            tried = _stepped(search, state, model, radius)
        if not tried.accepted:
            return _ended(search, state, factored, converged=False)
        state, radius = search.state(tried.positions), tried.radius
