"""One axis of a sweep: a key and the values that it takes."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from sesame_cad.quantities import parse_quantity

MOST_VALUES = 10_000
HOW = "write first:last:count, such as 0.1:0.5:9, or values with commas, or one value"

_NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,2})?")


@dataclass(frozen=True, slots=True)
class Axis:
    """Values of one key, in the unit that its name tells.

    Attributes
    ----------
    key : str
        ``"beta"``, or a key of a specification with its section.
    values : tuple of float
    """

    key: str
    values: tuple[float, ...]

    @property
    def swept(self) -> bool:
        """Whether there is more than one value."""
        return len(self.values) > 1


def parse_axis(key: str, text: str) -> Axis:
    """Read ``first:last:count`` (evenly spaced, both ends in), values with commas, or one value.

    A value is a number in the key's own unit, or a quantity with a unit: ``20mm:6cm:9``.

    Raises
    ------
    ValueError
        With one line that says how to write it.
    """
    parts = text.split(":")
    if len(parts) == 3:
        first, last = _value(key, parts[0]), _value(key, parts[1])
        values = np.linspace(first, last, _count(parts[2])).tolist()
        # 0.06 and not 0.060000000000000005: what a person would have written
        return Axis(key, tuple(float(f"{value:.12g}") for value in values))
    if len(parts) != 1:
        raise ValueError(f"{text!r} is no range: {HOW}")
    values = tuple(_value(key, part) for part in text.split(","))
    if len(values) > MOST_VALUES:
        raise ValueError(f"{len(values)} values: at most {MOST_VALUES}")
    if len(set(values)) < len(values):
        raise ValueError(f"{text!r} holds a value twice")
    return Axis(key, values)


def _count(text: str) -> int:
    digits = text.strip()
    if not (digits.isascii() and digits.isdigit() and 2 <= int(digits[:9]) <= MOST_VALUES):
        raise ValueError(f"count {text!r}: must be a whole number from 2 to {MOST_VALUES}")
    return int(digits)


def _value(key: str, text: str) -> float:
    if _NUMBER.fullmatch(text.strip()):
        return float(text)
    try:
        return parse_quantity(key, text)
    except ValueError as error:
        raise ValueError(f"{error}; {HOW}") from None
