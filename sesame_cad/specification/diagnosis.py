"""From what pydantic found to faults in a maker's words."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import TypeGuard, TypeVar

from pydantic import ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from sesame_cad.specification.allowed import (
    allowed_text,
    is_number,
    limits_text,
    nearest_word,
)
from sesame_cad.specification.beam import BeamSection
from sesame_cad.specification.consistency import Together, inconsistencies
from sesame_cad.specification.fault import Fault, shown_value
from sesame_cad.specification.layout import LayoutSection
from sesame_cad.specification.machine import MachineSection
from sesame_cad.specification.model import ModelSection
from sesame_cad.specification.nearest import nearest_key
from sesame_cad.specification.outline import OutlineSection
from sesame_cad.specification.output import OutputSection
from sesame_cad.specification.section import Section
from sesame_cad.specification.sleeve import SleeveSection
from sesame_cad.specification.specification import Specification, sections
from sesame_cad.specification.stitching import StitchingSection
from sesame_cad.specification.wire import WireSection
from sesame_cad.specification.wiring import WiringSection

SectionT = TypeVar("SectionT", bound=Section)


def diagnose(data: Mapping[str, object], error: ValidationError) -> tuple[Fault, ...]:
    """Give every fault of a specification once, those between the keys last.

    Parameters
    ----------
    data
        What was validated.
    error
        What came of it.
    """
    found = {fault.keys: fault for fault in own_faults(data, error)}
    return _without_echoes((*found.values(), *_faults_between(data, found)))


def own_faults(data: Mapping[str, object], error: ValidationError) -> Iterator[Fault]:
    """Give the faults of single keys, in sections of which some may be left out."""
    for detail in error.errors(include_url=False):
        keys = tuple(str(part) for part in detail["loc"][:2])
        if keys:
            yield _fault(keys, detail, _value_at(data, keys))


def _fault(keys: tuple[str, ...], detail: ErrorDetails, value: object) -> Fault:
    inside = len(detail["loc"]) > len(keys)  # of a list: the whole key is said
    if detail["type"] == "extra_forbidden" and not inside:
        return _unknown(keys)
    field = _field(keys)
    if detail["type"] == "missing" and not inside:
        return Fault(keys, f"missing; give {field.description}")
    if keys[0] in sections() and len(keys) == 1:
        return Fault(keys, f"must be a section, [{keys[0]}] with keys below", shown_value(value))
    return Fault(keys, _problem(field, detail, value), shown_value(value))


def _problem(field: FieldInfo, detail: ErrorDetails, value: object) -> str:
    if detail["type"] == "value_error":
        return str(detail.get("ctx", {}).get("error", detail["msg"]))
    if detail["type"] == "finite_number":
        return f"must be a finite number, {limits_text(field)}"
    near = nearest_word(field, value)
    meant = "" if near is None else f"; did you mean {near}?"
    return (
        f"must be {limits_text(field) if is_number(field, value) else allowed_text(field)}{meant}"
    )


def _unknown(keys: tuple[str, ...]) -> Fault:
    what = "unknown key" if len(keys) > 1 else "unknown section or key"
    near = nearest_key(keys)
    if near is None:
        known = sections()[keys[0]].model_fields if len(keys) > 1 else Specification.model_fields
        return Fault(keys, f"{what}; known here: {', '.join(known)}")
    return Fault(keys, f"{what}; did you mean {_shown_key(near, keys)}?", meant=near)


def _shown_key(near: tuple[str, ...], keys: tuple[str, ...]) -> str:
    if near[0] in sections() and len(near) == 1:
        return f"[{near[0]}]"
    return near[-1] if near[:-1] == keys[:-1] else ".".join(near)


def _without_echoes(faults: tuple[Fault, ...]) -> tuple[Fault, ...]:
    """Leave out what is missing only because its name is misspelt: one mistake, one line."""
    meant = {fault.meant for fault in faults if fault.meant}
    return tuple(
        fault
        for fault in faults
        if not fault.problem.startswith("missing") or not {fault.keys, fault.keys[:1]} & meant
    )


def _faults_between(
    data: Mapping[str, object], found: Collection[tuple[str, ...]]
) -> tuple[Fault, ...]:
    def sound(name: str, section: type[SectionT]) -> SectionT:
        keys = [key for key in section.model_fields if (name, key) not in found]
        given = {key: _value_at(data, (name, key)) for key in keys if _holds(data[name], key)}
        try:
            return section.model_validate(given)
        except ValidationError:  # a key is missing
            return section.model_construct(**given)  # pyright: ignore[reportArgumentType]

    together = Together(
        wire=sound("wire", WireSection),
        layout=sound("layout", LayoutSection),
        model=sound("model", ModelSection),
        wiring=sound("wiring", WiringSection),
        stitching=sound("stitching", StitchingSection),
        machine=sound("machine", MachineSection),
        outline=sound("outline", OutlineSection),
        output=sound("output", OutputSection),
        beam=sound("beam", BeamSection),
        sleeve=sound("sleeve", SleeveSection),
    )
    return inconsistencies(together, found)


def _field(keys: tuple[str, ...]) -> FieldInfo:
    if len(keys) == 1:
        return Specification.model_fields[keys[0]]
    return sections()[keys[0]].model_fields[keys[1]]


def _value_at(data: Mapping[str, object], keys: tuple[str, ...]) -> object:
    value: object = data
    for key in keys:
        value = value[key] if _holds(value, key) else None
    return value


def _holds(table: object, key: str) -> TypeGuard[Mapping[str, object]]:
    return isinstance(table, Mapping) and key in table
