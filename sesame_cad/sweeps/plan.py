"""What a sweep is to solve, cut into chunks that can be done in any order and anywhere."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from importlib.metadata import version
from typing import Any, Protocol

from sesame_cad.errors import InputError
from sesame_cad.sweeps.axis import Axis
from sesame_cad.sweeps.outcome import Outcome
from solver.errors import SceneError

MOST_POINTS = 1_000_000


class Model(Protocol):
    """What is solved at each point; plain data, so that it can be sent to other machines."""

    @property
    def points_at_once(self) -> int:
        """Points of a chunk."""
        ...

    def description(self) -> dict[str, Any]:
        """Say what it is, as plain data."""
        ...

    def check(self, keys: Sequence[str], point: Sequence[float]) -> None:
        """Raise `InputError` or `SceneError` where the model does not reach."""
        ...

    def solve(self, keys: Sequence[str], points: Sequence[tuple[float, ...]]) -> list[Outcome]:
        """Solve points."""
        ...


@dataclass(frozen=True)
class SweepPlan:
    """A grid of points, and the model that is solved at each.

    Attributes
    ----------
    model : Model
    axes : tuple of Axis
        The last varies fastest.
    """

    model: Model
    axes: tuple[Axis, ...]

    @property
    def keys(self) -> tuple[str, ...]:
        """Of the axes."""
        return tuple(axis.key for axis in self.axes)

    @property
    def swept(self) -> tuple[Axis, ...]:
        """Axes of more than one value."""
        return tuple(axis for axis in self.axes if axis.swept)

    @property
    def size(self) -> int:
        """Number of points."""
        return math.prod(len(axis.values) for axis in self.axes)

    @property
    def chunks(self) -> int:
        """Number of chunks."""
        return -(-self.size // self.model.points_at_once)

    @cached_property
    def points(self) -> tuple[tuple[float, ...], ...]:
        """All points, in the order of the table."""
        return tuple(itertools.product(*(axis.values for axis in self.axes)))

    def chunk(self, index: int) -> tuple[tuple[float, ...], ...]:
        """Give the points of one chunk.

        A chunk's points are the same however many machines share the work, so that its numbers are
        the same to the last bit.
        """
        first = index * self.model.points_at_once
        return self.points[first : first + self.model.points_at_once]

    def description(self) -> dict[str, Any]:
        """Say what is swept, as plain data: equal plans give equal tables."""
        return {
            "version": version("sesame-cad"),
            **self.model.description(),
            "axes": {axis.key: list(axis.values) for axis in self.axes},
        }

    def check(self) -> None:
        """Try the ends of every axis, each with the least and the greatest of the others.

        An end that goes with neither is a fault. One that goes with some is a matter of its points:
        those that cannot be say so in the table.

        Raises
        ------
        InputError
            With each fault once.
        """
        if self.size > MOST_POINTS:
            raise InputError(f"{self.size} points: a sweep has at most {MOST_POINTS}")
        faults: dict[str, None] = {}
        others = [[end(axis.values) for axis in self.axes] for end in (min, max)]
        for k, axis in enumerate(self.axes):
            for value in dict.fromkeys((min(axis.values), max(axis.values))):
                tried = [self._faults([*fixed[:k], value, *fixed[k + 1 :]]) for fixed in others]
                if all(tried):
                    faults.update(dict.fromkeys(tried[0]))
        if faults:
            raise InputError(*faults)

    def _faults(self, point: Sequence[float]) -> tuple[str, ...]:
        try:
            self.model.check(self.keys, point)
        except InputError as error:
            return error.faults
        except SceneError as error:
            return (str(error),)
        return ()


def solve_chunk(
    model: Model, keys: tuple[str, ...], points: tuple[tuple[float, ...], ...]
) -> list[Outcome]:
    """Solve one chunk, here or on another machine."""
    return model.solve(keys, points)
