"""Sweeps of a grid of dimensionless loops, which a mesh solves one point at a time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from sesame_cad.sweeps.outcome import Outcome
from solver.checks import CONTACT, SLACK
from solver.errors import NotConvergedError, SceneError
from solver.ladder.answer import Answer, Rung
from solver.ladder.choose import solve_scene
from solver.ladder.fidelity import Fidelity
from solver.mesh.array_mesh import Between
from solver.mesh.scene import ArrayScene
from solver.reading import Reading
from solver.scene import LoopScene


@dataclass(frozen=True, slots=True)
class ArrayModel:
    """A grid of dimensionless loops; the keys are those of `sesame_cad.sweeps.loops`.

    Attributes
    ----------
    rows, columns : int
    between : str
        ``"cut"`` or ``"kept"``.
    reading : str
    tolerance : float
        Error allowed in the height, relative to it.
    """

    rows: int
    columns: int
    between: str
    reading: str
    tolerance: float

    @property
    def points_at_once(self) -> int:
        """Points of a chunk: each takes seconds."""
        return 1

    def description(self) -> dict[str, Any]:
        """Say what it is, as plain data."""
        return {"model": "array", **asdict(self)}

    def check(self, keys: Sequence[str], point: Sequence[float]) -> None:
        """Raise `SceneError` where the model does not reach."""
        self._scene(keys, point)

    def solve(self, keys: Sequence[str], points: Sequence[tuple[float, ...]]) -> list[Outcome]:
        """Solve points, one after the other."""
        return [self._solve(self._scene(keys, point)) for point in points]

    def _scene(self, keys: Sequence[str], point: Sequence[float]) -> ArrayScene:
        loop = LoopScene(**dict(zip(keys, point, strict=True)), reading=Reading(self.reading))
        return ArrayScene(loop, self.rows, self.columns, Between(self.between))

    def _solve(self, scene: ArrayScene) -> Outcome:
        loop = scene.loop
        try:
            answer = solve_scene(scene, fidelity=Fidelity.AUTO, tolerance=self.tolerance)
        except (SceneError, NotConvergedError) as error:
            return Outcome(loop.strain, loop.beta, loop.poisson, status=str(error))
        slack, meets = left_out(answer)
        found = answer.equilibrium
        # where loops tile, one of them is all that is solved
        alike = self.rows * self.columns if answer.rung is Rung.COMPACT else 1
        return Outcome(
            loop.strain,
            loop.beta,
            loop.poisson,
            height_over_perimeter=answer.height_over_perimeter,
            energy=None if found is None else alike * found.energy,
            buckled=answer.buckled,
            slack=slack,
            self_meeting=meets,
        )


def left_out(answer: Answer) -> tuple[bool, bool]:
    """Whether fabric is slack though the model lets it be, and whether the shape meets itself.

    Where the mesh has solved with fabric that wrinkles, or with contact, these are no faults.
    """
    matters = {left.term: left.matters and not math.isnan(left.value) for left in answer.omitted}
    fatal = {left.term: left.fatal for left in answer.omitted}
    return matters.get(SLACK, False), fatal.get(CONTACT, False)
