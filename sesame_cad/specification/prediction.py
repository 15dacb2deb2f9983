"""How the shape is predicted: from one cell, of all loops together, or not at all."""

from __future__ import annotations

from typing import Literal

from sesame_cad.specification.layout import SLEEVE, TILING, LayoutSection
from sesame_cad.specification.model import ModelSection
from sesame_cad.specification.wire import WireSection
from sesame_cad.specification.wiring import WiringSection

MOST_COUPLED = 36
"""Loops of a coupled shape: so many take minutes on meshes refined once."""

_STIFFNESS = ("diameter_mm", "modulus_cold_GPa", "modulus_hot_GPa")


def coupled_because(layout: LayoutSection, wiring: WiringSection, wire: WireSection) -> str | None:
    """Say why one cell is not all there is to solve; None when it is.

    A grid with missing cells still tiles: every contact that is left is as before, between two
    equal saddles on a crest or in a valley of both, and a free edge asks for nothing.
    """
    if layout.kind not in TILING:
        return (
            f'for layout.kind = "{layout.kind}" the loops do not fit together each in the shape '
            "that it takes alone"
        )
    if layout.axis_ratio != 1:
        return "the lowest saddle of an ellipse is diagonal and does not fit beside itself"
    if len(set(layout.diameters_mm)) > 1:
        return "the loops of the row have different diameters"
    if layout.between == "kept" and min(layout.rows or 1, layout.columns or 1) > 1:
        return 'the fabric between the loops couples them (layout.between = "kept")'
    for one in wiring.circuits:
        own = one.wire(wire)
        if any(getattr(own, key) != getattr(wire, key) for key in _STIFFNESS):
            return f"the wire of circuit {one.name} is another than [wire]"
    return None


def predicted_shape(
    layout: LayoutSection, model: ModelSection, wiring: WiringSection, wire: WireSection
) -> Literal["cell", "coupled", "none"]:
    """Give the prediction that is asked for; that which holds, where it is left open.

    Sleeves are no array that lies flat: theirs is another (`sesame_cad.sleeve`).
    """
    if layout.kind == SLEEVE:
        return "none"
    if layout.shape != "auto":
        return layout.shape
    alone = model.fidelity != "mesh" and coupled_because(layout, wiring, wire) is None
    return "cell" if alone else "coupled"
