"""Which part of the slider's way is heating, and between which temperatures it runs."""

from __future__ import annotations

from typing import Any

from sesame_cad.specification import Specification

Data = dict[str, Any]


def heating_data(spec: Specification) -> Data:
    """As and Af, between which a heated wire transforms.

    The page finds the temperature of a state between them from its fraction of austenite by the law
    of `solver.actuation.transformation.Transformation.heated_to`.
    """
    start_C = spec.wire.transition_C  # noqa: N806
    return {"startC": start_C, "finishC": start_C + spec.actuation.heating_span_C}


def austenite_fraction(spec: Specification, modulus_GPa: float | None) -> float | None:  # noqa: N803
    """Fraction of austenite in wire of this modulus, by the rule of mixtures of `HeatedWire`.

    None where no modulus tells it: of the loop as it is sewn, or if both phases are alike.
    """
    cold, hot = spec.wire.modulus_cold_GPa, spec.wire.modulus_hot_GPa
    if modulus_GPa is None or cold == hot:
        return None
    return (modulus_GPa - cold) / (hot - cold)
