"""A specification to start from, with every key explained."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from textwrap import wrap
from types import MappingProxyType

from pydantic.fields import FieldInfo

from sesame_cad.specification import specification_from
from sesame_cad.specification.allowed import allowed_text
from sesame_cad.specification.specification import Specification, sections
from sesame_cad.specification.toml_text import number_text, toml_value

LINE_LENGTH = 98

STARTER: Mapping[str, Mapping[str, object]] = MappingProxyType(
    {
        "wire": {"diameter_mm": 0.5},
        "layout": {"rows": 4, "columns": 4, "loop_diameter_mm": 50},
    }
)
"""Values of the keys that have no default: the large array of the paper's Table I."""

_HEAD = """\
A SESAME array. A setting behind a # has the value shown anyway; to change it, take the # away.
Every setting has its unit in its name or its comment.
"""


def starter_toml(name: str) -> str:
    """Write a specification of a 4 × 4 array in which a comment explains every key.

    Parameters
    ----------
    name
        The design's name.

    Raises
    ------
    InputError
        When the name will not do.
    """
    specification = specification_from({**STARTER, "name": name}, name, "starter file")
    return "\n".join(_lines(specification)) + "\n"


def _lines(specification: Specification) -> Iterator[str]:
    yield from _comment(_HEAD)
    yield ""
    yield from _comment(_explained(Specification.model_fields["name"]))
    yield f"name = {toml_value(specification.name)}"
    for name, section in sections().items():
        yield ""
        yield from _comment(_sentence(Specification.model_fields[name].description))
        yield f"[{name}]"
        for key, field in section.model_fields.items():
            yield from _comment(_explained(field))
            value = _value(key, name, specification)
            yield f"{'' if key in STARTER.get(name, {}) else '#'}{key} = {value}"


def _value(key: str, section: str, specification: Specification) -> str:
    value = getattr(getattr(specification, section), key)
    if value is None:  # follows from other keys: the specification knows it under the same name
        value = getattr(specification, key)
    return number_text(value) if isinstance(value, float) else toml_value(value)


def _explained(field: FieldInfo) -> str:
    return f"{_sentence(field.description)} Must be {allowed_text(field)}."


def _sentence(description: str | None) -> str:
    text = description or ""
    return f"{text[:1].upper()}{text[1:]}."


def _comment(text: str) -> list[str]:
    return [f"# {line}" for line in wrap(text, LINE_LENGTH)]
