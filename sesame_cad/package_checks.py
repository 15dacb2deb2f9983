"""Checks that the folders of all kinds of designs have in common."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import groupby

from patterns.errors import PatternError
from patterns.violation import Violation
from sesame_cad.cut_checks import CUT_READERS, cut_faults
from sesame_cad.errors import DesignFileError
from sesame_cad.package_files import file_data
from sesame_cad.pipeline import Design
from sesame_cad.reading import Reading
from sesame_cad.staging import DESIGN_FILE
from sesame_cad.stitch_checks import stitch_faults

MOST_OF_A_RULE = 5
"""More faults of one design rule are only counted."""

MOST_FAULTS = 100
"""More faults of a kind are only counted."""

Faults = Iterator[str]


@dataclass(frozen=True)
class Verification:
    """What was found in a folder.

    Attributes
    ----------
    faults : tuple of str
        One line each; empty when every file is as it should be.
    sewn : Design or None
        The design with the plan that the DST file holds, of several the first that breaks rules;
        None when there is no such plan.
    violations : tuple of Violation
        Rules that this plan breaks.
    """

    faults: tuple[str, ...]
    sewn: Design | None = None
    violations: tuple[Violation, ...] = ()


def limited(faults: Iterator[str], most: int) -> Faults:
    """Give the first of some faults, and how many more there are."""
    more = 0
    for count, fault in enumerate(faults):
        if count < most:
            yield fault
        else:
            more += 1
    if more:
        yield f"... and {more} more of this kind"


def file_faults(reading: Reading, expected: Iterable[str]) -> Faults:
    """Find listed files that are missing or changed, others, and those that are not listed."""
    listed = reading.data["files"]
    for path, said in listed.items():
        content = reading.content(path)
        if content is None:
            yield f"{path}: {reading.lack(path)}"
        elif file_data(content) != said:
            yield f"{path}: changed since it was written (its size or hash is another)"
    for file in sorted(reading.folder.rglob("*")):
        path = file.relative_to(reading.folder).as_posix()
        if file.is_file() and path != DESIGN_FILE and path not in listed:
            yield f"{path}: not listed in {DESIGN_FILE}"
    for path in expected:
        if path not in listed:
            yield f"{path}: not listed in {DESIGN_FILE}, though the design needs it"


def sewn_faults(reading: Reading) -> Faults:
    """Find where stitch files do not hold the plan, or break a rule."""
    yield from stitch_faults(reading)
    path = f"stitch/{reading.made.spec.name}.dst"
    yield from (f"{path}: {fault}" for fault in _rule_faults(reading))


def _rule_faults(reading: Reading) -> Faults:
    try:
        violations = reading.violations
    except DesignFileError:
        return  # which is told of the file
    except PatternError as error:
        yield str(error)
        return
    for _, of_rule in groupby(violations, key=lambda violation: violation.rule):
        yield from limited(map(str, of_rule), MOST_OF_A_RULE)


def fabric_faults(reading: Reading) -> Faults:
    """Find where cut files do not hold the outline, closed, in mm, clear of wire and needle."""
    for kind in CUT_READERS:
        path = f"cut/{reading.made.spec.name}.{kind}"
        content = reading.content(path)
        if content is not None:
            faults = cut_faults(content, kind, reading.made)
            yield from (f"{path}: {fault}" for fault in faults)
