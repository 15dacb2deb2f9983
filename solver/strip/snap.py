"""Both stable states of a strip, the barrier between them, and the couples that snap it through."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from solver.errors import NotConvergedError
from solver.omitted import OmittedTerm
from solver.strip.balance import Balance, Point
from solver.strip.basis import StripBasis, strip_basis
from solver.strip.mirror import mirrored
from solver.strip.omissions import left_out
from solver.strip.path import Branch, carried, stable_branch
from solver.strip.phase import at_rest, first_state, saddles
from solver.strip.scene import StripScene
from solver.strip.state import Side, StripState, strip_state

DEGREE = 24
"""Of the curvature's polynomials on each piece."""
_LARGEST_TRUNCATION = 1e-3
"""Share of the curvature; the energy's error is of the order of its square."""
_BEYOND = 1e-6
"""By which a state must outlast another's critical couple, relative to it."""


@dataclass(frozen=True)
class Snap:
    """How one state gives way to a couple that grows from 0 in one sense.

    Attributes
    ----------
    before : StripState
        The state at the critical couple, where it ends.
    after : StripState or None
        The other state at the same couple, or one between + and − where that is gone as well;
        None where neither is found at a lower energy, as under couples far beyond those at which
        the other state snaps.
    merges : bool
        Whether the state goes over into one between + and − gently instead of snapping.
    """

    before: StripState
    after: StripState | None
    merges: bool

    @property
    def critical_couple_N_m(self) -> float:  # noqa: N802 - the units' own names
        """Couple at which the state loses its stability."""
        return self.before.couple_N_m

    @property
    def released_J(self) -> float | None:  # noqa: N802
        """Energy before less energy after, at the critical couple; None without a state after."""
        return self.before.energy_J - self.after.energy_J if self.after else None

    def margin(self, couple_N_m: float) -> float:  # noqa: N803
        """Couple over critical couple, less 1; greater than 0 where the couple snaps the strip."""
        return couple_N_m / self.critical_couple_N_m - 1


@dataclass(frozen=True)
class Bistable:
    """What becomes of a strip, in SI units.

    Attributes
    ----------
    scene : StripScene
    unloaded : dict
        States + and − without couple.
    loaded : dict
        Stable states at the scene's couple: of + and − those which it has not snapped, and
        ``between`` where they have merged.
    saddle : StripState or None
        The lowest unstable shape between them at that couple.
    pushed : dict
        For each state, how a couple against its curvature snaps it; without those that none up to
        the largest couple snaps.
    pressed : dict
        The same for a couple that bends it further its own way.
    omitted : tuple of OmittedTerm
    """

    scene: StripScene
    unloaded: dict[Side, StripState]
    loaded: dict[Side, StripState]
    saddle: StripState | None
    pushed: dict[Side, Snap]
    pressed: dict[Side, Snap]
    omitted: tuple[OmittedTerm, ...]

    def barrier_J(self, side: Side) -> float | None:  # noqa: N802
        """Energy from a state at the scene's couple up to the saddle.

        0 where the couple has snapped the state; None where no saddle is left, as the couple has
        snapped the other one.
        """
        if side not in self.loaded:
            return 0.0
        return self.saddle.energy_J - self.loaded[side].energy_J if self.saddle else None

    def snap(self, side: Side) -> Snap | None:
        """How the scene's couple, in its own sense, would snap a state, if any couple does."""
        against = (self.scene.couple_N_m >= 0) == (side is Side.UP)
        return (self.pushed if against else self.pressed).get(side)

    def snaps(self, side: Side) -> bool:
        """Whether the scene's couple snaps a state."""
        return side not in self.loaded


def scene_basis(scene: StripScene) -> StripBasis:
    """Give the basis in which a scene is solved."""
    return strip_basis(scene.covered, scene.ends, DEGREE).stiffened(scene.stiffening)


@dataclass(frozen=True)
class _Search:
    """A scene's balance, and what both of its states have in common."""

    scene: StripScene

    @cached_property
    def balance(self) -> Balance:
        return at_rest(scene_basis(self.scene), self.scene.shortening)

    @cached_property
    def start(self) -> Point:
        return first_state(self.balance, self.scene.ends)

    @cached_property
    def pushed(self) -> Branch:
        return stable_branch(self.balance, self.start, 1, self._limit)

    @cached_property
    def pressed(self) -> Branch:
        return stable_branch(self.balance, self.start, -1, self._limit)

    @cached_property
    def saddles(self) -> tuple[Point, Point]:
        return saddles(self.balance, self.scene.ends, self.start)

    @property
    def _limit(self) -> float:
        return self.scene.largest_couple_N_m / self.scene.energy_unit_J

    @property
    def couple(self) -> float:
        return self.scene.couple_N_m / self.scene.energy_unit_J

    def of(self, side: Side, couple: float) -> Point | None:
        """Stable state of a side at a couple."""
        if side is Side.DOWN:
            found = self.of(Side.UP, -couple)
            return mirrored(found) if found else None
        return (self.pushed if couple >= 0 else self.pressed).at(couple)

    def read(self, point: Point, side: Side) -> StripState:
        state = strip_state(self.scene, self.balance, point, side)
        if not state.truncation <= _LARGEST_TRUNCATION:
            raise NotConvergedError(
                f"the strip's shape is too sharply bent at a couple of {state.couple_N_m:g} N m: "
                f"{state.truncation:.0e} of its curvature is left out"
            )
        return state


def _after(search: _Search, other: Side, before: StripState, couple: float) -> StripState | None:
    """Where a strip comes to rest that a couple has snapped out of its state."""
    # where the other state ends at the same couple, by symmetry, neither is there any longer
    lasts = search.of(other, (1 + _BEYOND) * couple)
    point = search.of(other, couple) if lasts else None
    rest = search.read(point, other) if point else _between(search, couple)[1]
    return rest if rest and rest.energy_J < before.energy_J else None


def _snap(search: _Search, side: Side, branch: Branch, end: Point) -> Snap:
    other = Side.DOWN if side is Side.UP else Side.UP
    point = end if side is Side.UP else mirrored(end)
    before = search.read(point, side)
    after = None if branch.merges else _after(search, other, before, point.couple)
    return Snap(before, after, branch.merges)


def _snaps(search: _Search, branch: Branch) -> dict[Side, Snap]:
    if branch.end is None:
        return {}
    return {side: _snap(search, side, branch, branch.end) for side in (Side.UP, Side.DOWN)}


def _between(search: _Search, couple: float) -> tuple[StripState | None, StripState | None]:
    """Find the lowest unstable shape at a couple, and the lowest that became stable."""
    found = [carried(search.balance, start, couple) for start in search.saddles]
    read = [search.read(point, Side.BETWEEN) for point in found if point]
    return (
        _lowest([state for state in read if state.eigenvalue_J < 0]),
        _lowest([state for state in read if state.eigenvalue_J > 0]),
    )


def _lowest(states: list[StripState]) -> StripState | None:
    return min(states, key=lambda state: state.energy_J, default=None)


def _states(search: _Search, couple: float) -> dict[Side, StripState]:
    points = {side: search.of(side, couple) for side in (Side.UP, Side.DOWN)}
    return {side: search.read(point, side) for side, point in points.items() if point}


def solve_strip(scene: StripScene) -> Bistable:
    """Find a strip's states, the barrier between them, and what snaps it.

    Raises
    ------
    NotConvergedError
        When a state cannot be followed, or none is stable at the scene's couple.
    """
    search = _Search(scene)
    unloaded, loaded = _states(search, 0.0), _states(search, search.couple)
    saddle, merged = _between(search, search.couple)
    if merged:
        loaded[Side.BETWEEN] = merged
    if not loaded:
        raise NotConvergedError(
            f"no stable shape was found at a couple of {scene.couple_N_m:g} N m: both states and "
            "what lies between them end before it; take a smaller couple"
        )
    return Bistable(
        scene=scene,
        unloaded=unloaded,
        loaded=loaded,
        saddle=saddle,
        pushed=_snaps(search, search.pushed),
        pressed=_snaps(search, search.pressed),
        omitted=left_out(scene, unloaded[Side.UP]),
    )
