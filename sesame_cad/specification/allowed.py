"""What a key may hold, in words, from its declaration."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches
from types import MappingProxyType, UnionType
from typing import Literal, Union, get_args, get_origin

from annotated_types import Ge, Gt, Le, Lt
from pydantic.fields import FieldInfo

from sesame_cad.specification.section import Allowed
from sesame_cad.specification.toml_text import number_text, toml_value

_KINDS: Mapping[object, str] = MappingProxyType(
    {float: "a number", int: "a whole number", bool: "true or false"}
)


def limits_text(field: FieldInfo) -> str:
    """Say the limits of a number: "greater than -1 and less than 0.5"; empty without any."""
    match [item for item in field.metadata if isinstance(item, (Gt, Ge, Lt, Le))]:
        case [Ge(ge=least), Le(le=most)]:
            return f"from {_bound(least)} to {_bound(most)}"
        case limits:
            return " and ".join(map(_limit, limits))


def kind_text(field: FieldInfo) -> str:
    """Say what kind of value a key holds, without its limits: "a number", "a whole number"."""
    for item in field.metadata:
        if isinstance(item, Allowed):
            return item.text
    return _annotation_text(field.annotation)


def allowed_text(field: FieldInfo) -> str:
    """Say in full what a key may hold: "a number greater than -1 and less than 0.5"."""
    limits = limits_text(field)
    return f"{kind_text(field)} {limits}" if limits else kind_text(field)


def nearest_word(field: FieldInfo, value: object) -> str | None:
    """Give the allowed word that is most like a wrong one, also of a list; none if none is."""
    words = [word for word in _words(field.annotation) if isinstance(word, str)]
    given = value if isinstance(value, (list, tuple)) else [value]
    wrong = [one for one in given if isinstance(one, str) and one not in words]
    near = get_close_matches(wrong[0], words, 1) if wrong else []
    return near[0] if near else None


def _words(annotation: object) -> tuple[object, ...]:
    if get_origin(annotation) is Literal:
        return get_args(annotation)
    return tuple(word for part in get_args(annotation) for word in _words(part))


def is_number(field: FieldInfo, value: object) -> bool:
    """Tell whether a value is of the kind the key holds, so that only its size can be wrong."""
    kinds = int if kind_text(field) == "a whole number" else (int, float)
    return bool(limits_text(field)) and isinstance(value, kinds) and not isinstance(value, bool)


def _limit(item: Gt | Ge | Lt | Le) -> str:
    match item:
        case Gt(gt=bound):
            return f"greater than {_bound(bound)}"
        case Ge(ge=bound):
            return f"at least {_bound(bound)}"
        case Lt(lt=bound):
            return f"less than {_bound(bound)}"
        case Le(le=bound):
            return f"at most {_bound(bound)}"


def _bound(bound: object) -> str:
    return number_text(bound) if isinstance(bound, (int, float)) else str(bound)


def _annotation_text(annotation: object) -> str:
    if get_origin(annotation) is Literal:
        return _choice(get_args(annotation))
    if get_origin(annotation) is tuple:
        return f"a list, each item {_annotation_text(get_args(annotation)[0])}"
    if get_origin(annotation) in (Union, UnionType):
        return _annotation_text(get_args(annotation)[0])
    return _KINDS[annotation]


def _choice(words: tuple[object, ...]) -> str:
    quoted = [toml_value(word) for word in words]
    return quoted[0] if len(quoted) == 1 else f"one of {', '.join(quoted)}"
