"""Which violations are shown by number, and which only as one more place."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import groupby

from patterns.violation import Violation

MOST_NUMBERED = 10
"""Violations of a rule that are told one by one: a setting may break it all over the array."""


@dataclass(frozen=True, slots=True)
class NumberedFaults:
    """The violations of one rule.

    Attributes
    ----------
    rule : str
    numbered : tuple of (int, Violation)
        With numbers that count from 1 through all rules.
    others : tuple of Violation
    """

    rule: str
    numbered: tuple[tuple[int, Violation], ...]
    others: tuple[Violation, ...]

    def labels(self) -> dict[tuple[float, float], str]:
        """Give what is written at each place (mm): its numbers, such as "1, 2"."""
        places: dict[tuple[float, float], str] = {}
        for number, violation in self.numbered:
            place = violation.x_mm, violation.y_mm
            places[place] = f"{places[place]}, {number}" if place in places else str(number)
        return places

    def legend(self) -> tuple[str, ...]:
        """Give a line for each number, and one for what has none."""
        lines = [f"{number}  {violation}" for number, violation in self.numbered]
        more = [f"{self.rule}: {len(self.others)} more places"] if self.others else []
        return (*lines, *more)


def numbered_faults(violations: tuple[Violation, ...]) -> tuple[NumberedFaults, ...]:
    """Number violations rule by rule, in order."""
    found: list[NumberedFaults] = []
    count = 0
    for rule, group in groupby(violations, key=lambda violation: violation.rule):
        own = tuple(group)
        numbered = tuple(enumerate(own[:MOST_NUMBERED], start=count + 1))
        count += len(numbered)
        found.append(NumberedFaults(rule, numbered, own[MOST_NUMBERED:]))
    return tuple(found)
