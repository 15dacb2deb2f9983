"""The scene of a specification, as `design` solves it, for other programs that solve it."""

from __future__ import annotations

from functools import partial

from patterns.layout import tangent_layout
from sesame_cad.coupled_state import coupled_scene
from sesame_cad.errors import InputError
from sesame_cad.pipeline import refusing
from sesame_cad.specification import Specification
from sesame_cad.specification.layout import SLEEVE
from sesame_cad.specification.prediction import predicted_shape
from sesame_cad.state import loop_materials, loop_scene
from solver.mesh.sheet import SheetScene
from solver.scene import LoopScene


def specified_scene(spec: Specification, state: str) -> LoopScene | SheetScene:
    """Give one loop where it stands for all, in units of its radius; else all of them.

    Those are in units of the largest loop's radius.

    Parameters
    ----------
    state : str
        ``"cold"`` or ``"hot"``: which of the wires' moduli.

    Raises
    ------
    InputError
        When the loops cannot be laid, or lie outside the model.
    """
    if spec.layout.kind == SLEEVE:
        raise InputError(
            f'{spec.name}: layout.kind = "{SLEEVE}": the plastic beams in sleeves are no loops on '
            "fabric; give an array"
        )
    return refusing(spec, partial(_scene, spec, state))


def _scene(spec: Specification, state: str) -> LoopScene | SheetScene:
    shape = spec.predicted_shape
    if shape == "none":
        layout = spec.layout.model_copy(update={"shape": "auto"})
        shape = predicted_shape(layout, spec.model, spec.wiring, spec.wire)
    if shape == "coupled":
        layout = tangent_layout(spec.layout.loops(), spec.layout.tolerance_mm)
        return coupled_scene(spec, layout, state)
    modulus = spec.wire.modulus_cold_GPa if state == "cold" else spec.wire.modulus_hot_GPa
    return loop_scene(spec, loop_materials(spec, modulus))
