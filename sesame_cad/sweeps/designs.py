"""Sweeps of a specification's numbers: from one design to a whole space of designs."""

from __future__ import annotations

import types
import typing
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from math import pi
from typing import Any

import numpy as np

from patterns.errors import PatternError
from patterns.layout import tangent_layout
from sesame_cad.coupled_state import solve_coupled
from sesame_cad.errors import InputError
from sesame_cad.specification import Specification, specification_from
from sesame_cad.specification.section import Section
from sesame_cad.state import loop_materials, loop_scene
from sesame_cad.sweeps.arrays import left_out
from sesame_cad.sweeps.loops import KEYS, solve_loops
from sesame_cad.sweeps.outcome import Outcome
from solver.errors import NotConvergedError, SceneError
from solver.materials import LoopMaterials
from solver.scene import LoopScene


@lru_cache(maxsize=1)
def numeric_keys() -> Mapping[str, type[int] | type[float]]:
    """Keys of a specification that hold one number, with its type."""
    found: dict[str, type[int] | type[float]] = {}
    for name, field in Specification.model_fields.items():
        section = field.annotation
        if not (isinstance(section, type) and issubclass(section, Section)):
            continue
        for key, own in section.model_fields.items():
            kinds = _alternatives(own.annotation) - {type(None)}
            if kinds in ({int}, {float}):
                found[f"{name}.{key}"] = int if kinds == {int} else float
    return found


def _alternatives(annotation: object) -> set[object]:
    union = isinstance(annotation, types.UnionType) or (
        typing.get_origin(annotation) is typing.Union
    )
    return set(typing.get_args(annotation)) if union else {annotation}


@dataclass(frozen=True)
class DesignModel:
    """A specification, cold or hot.

    Attributes
    ----------
    mapping : mapping
        The specification in full, as a TOML parser gives it.
    state : str
        ``"cold"`` or ``"hot"``.
    coupled : bool
        Whether its loops are solved together on a mesh.
    """

    mapping: Mapping[str, Any]
    state: str
    coupled: bool

    @property
    def points_at_once(self) -> int:
        """Points of a chunk."""
        return 1 if self.coupled else 512

    def description(self) -> dict[str, Any]:
        """Say what it is, as plain data."""
        return {"model": "design", "state": self.state, "specification": dict(self.mapping)}

    def check(self, keys: Sequence[str], point: Sequence[float]) -> None:
        """Raise `InputError` or `SceneError` where there is no such design."""
        spec = self._specification(keys, point)
        if spec.predicted_shape == "none":
            raise InputError('layout.shape = "none": there is no shape to sweep; use "auto"')
        self._scene(spec)

    def solve(self, keys: Sequence[str], points: Sequence[tuple[float, ...]]) -> list[Outcome]:
        """Solve points; a design that cannot be says so in its status."""
        outcomes: dict[int, Outcome] = {}
        cells: dict[int, tuple[Specification, LoopMaterials, LoopScene]] = {}
        for i, point in enumerate(points):
            try:
                spec = self._specification(keys, point)
                if spec.predicted_shape == "cell":
                    cells[i] = (spec, *self._scene(spec))
                else:
                    outcomes[i] = self._solve_coupled(spec)
            except (InputError, PatternError, SceneError, NotConvergedError) as error:
                outcomes[i] = Outcome(None, None, None, status="; ".join(str(error).split("\n")))
        outcomes.update(zip(cells, _solve_cells(list(cells.values())), strict=True))
        return [outcomes[i] for i in range(len(points))]

    def _specification(self, keys: Sequence[str], point: Sequence[float]) -> Specification:
        sections = {
            name: dict(value) if isinstance(value, dict) else value
            for name, value in self.mapping.items()
        }
        for keyed, value in zip(keys, point, strict=True):
            section, _, key = keyed.partition(".")
            whole = numeric_keys()[keyed] is int and value == int(value)
            sections.setdefault(section, {})[key] = int(value) if whole else value
        at = ", ".join(f"{key} = {value:g}" for key, value in zip(keys, point, strict=True))
        return specification_from(sections, "sweep", at)

    def _modulus_GPa(self, spec: Specification) -> float:  # noqa: N802 - the unit's own spelling
        return spec.wire.modulus_cold_GPa if self.state == "cold" else spec.wire.modulus_hot_GPa

    def _scene(self, spec: Specification) -> tuple[LoopMaterials, LoopScene]:
        materials = loop_materials(spec, self._modulus_GPa(spec))
        return materials, loop_scene(spec, materials)

    def _solve_coupled(self, spec: Specification) -> Outcome:
        layout = tangent_layout(spec.layout.loops(), spec.layout.tolerance_mm)
        _, scene = self._scene(spec)
        found = solve_coupled(spec, layout, self.state, lambda _: None)
        slack, meets = left_out(found.answer)
        pitch_mm = found.pitch_mm
        return Outcome(
            scene.strain,
            scene.beta,
            scene.poisson,
            height_over_perimeter=found.answer.height_over_perimeter,
            pitch_over_diameter=None if pitch_mm is None else pitch_mm / spec.layout.diameter_mm,
            energy=found.found.energy,
            height_mm=found.height_mm,
            pitch_mm=pitch_mm,
            energy_mJ=found.energy_mJ,
            buckled=found.buckled,
            slack=slack,
            self_meeting=meets,
        )


def _solve_cells(cells: Sequence[tuple[Specification, LoopMaterials, LoopScene]]) -> list[Outcome]:
    """Solve designs of which one loop is all there is to solve, all at once."""
    if not cells:
        return []
    spec = cells[0][0]
    given = {
        key: np.array([getattr(scene, key) for _, _, scene in cells], dtype=float) for key in KEYS
    }
    found = solve_loops(given, spec.model.reading, spec.model.tolerance)
    return [
        in_mm(outcome, materials) for outcome, (_, materials, _) in zip(found, cells, strict=True)
    ]


def in_mm(outcome: Outcome, materials: LoopMaterials) -> Outcome:
    """Give a loop's outcome with its size."""
    diameter_mm = 2e3 * materials.loop_radius_m
    height, pitch, energy = (
        outcome.height_over_perimeter,
        outcome.pitch_over_diameter,
        outcome.energy,
    )
    return replace(
        outcome,
        height_mm=None if height is None else height * pi * diameter_mm,
        pitch_mm=None if pitch is None else pitch * diameter_mm,
        energy_mJ=None if energy is None else energy * materials.energy_unit_J * 1e3,
    )
