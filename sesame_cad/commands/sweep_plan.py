"""What the options of ``sesame-cad sweep`` ask for, as a plan.

Each kind of sweep imports its own model, so that one of loops need not wait for that of designs.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

from sesame_cad.errors import InputError
from sesame_cad.sweeps.axis import Axis, parse_axis
from sesame_cad.sweeps.fig_2 import FIG_2
from sesame_cad.sweeps.plan import SweepPlan

_GRID = re.compile(r"([1-9][0-9]{0,2})\s*[x×]\s*([1-9][0-9]{0,2})")


def _axes(ranges: dict[str, str], named: Callable[[str], str]) -> tuple[Axis, ...]:
    """Read the ranges of keys; all faults at once, each with the option that gave it."""
    axes: list[Axis] = []
    faults: list[str] = []
    for key, text in ranges.items():
        try:
            axes.append(parse_axis(key, text))
        except ValueError as error:
            faults.append(f"{named(key)}: {error}")
    if faults:
        raise InputError(*faults)
    return tuple(axes)


def loops_plan(sets: tuple[str, ...], state: str | None, given: dict[str, Any]) -> SweepPlan:
    """Plan a sweep of the dimensionless model, by default over Fig. 2.

    Parameters
    ----------
    sets : tuple of str
        ``KEY=RANGE`` each.
    state : str or None
        Neither it nor ``sets`` goes with this model
    given : dict
        The options of the dimensionless model by name, None where they are not given.

    Raises
    ------
    InputError
        With one line for each fault.
    """
    if sets or state is not None:
        raise InputError("--set and --state are keys of a specification: give SPEC")
    from sesame_cad.sweeps.loops import KEYS, LoopModel

    ranges = {key: given[key] if given[key] is not None else FIG_2[key] for key in KEYS}
    axes = _axes(ranges, lambda key: f"--{key.replace('_', '-')}")
    reading = given["reading"] or FIG_2["reading"]
    grid = _GRID.fullmatch((given["loops"] or "1x1").strip())
    if grid is None:
        raise InputError(f"--loops: {given['loops']!r} is not rows x columns, such as 3x3")
    rows, columns = int(grid[1]), int(grid[2])
    if rows * columns == 1:
        if given["between"] is not None:
            raise InputError("--between: there is nothing between one loop; give --loops")
        return SweepPlan(LoopModel(reading, given["tolerance"] or 1e-3), axes)
    from sesame_cad.sweeps.arrays import ArrayModel

    between, tolerance = given["between"] or "cut", given["tolerance"] or 0.1
    return SweepPlan(ArrayModel(rows, columns, between, reading, tolerance), axes)


def designs_plan(path: Path, sets: tuple[str, ...], state: str, given: dict[str, Any]) -> SweepPlan:
    """Plan a sweep of a specification's keys.

    Parameters
    ----------
    path : Path
        Of the specification.
    sets : tuple of str
        ``KEY=RANGE`` each.
    state : str
        ``"cold"`` or ``"hot"``.
    given : dict
        The options of the dimensionless model by name, None where they are not given; none may be.

    Raises
    ------
    InputError
        With one line for each fault.
    """
    faults = [
        f"--{option.replace('_', '-')}: not with SPEC, whose own keys say it"
        for option, value in given.items()
        if value is not None
    ]
    if faults:
        raise InputError(*faults)
    from sesame_cad.specification import load_specification
    from sesame_cad.sweeps.designs import DesignModel, numeric_keys

    ranges: dict[str, str] = {}
    for text in sets:
        key, equals, values = text.partition("=")
        key = key.strip()
        if not equals:
            faults.append(f"--set {text!r}: write KEY=RANGE, such as wire.diameter_mm=0.3:0.6:7")
        elif key not in numeric_keys():
            faults.append(f"--set {key}: {_no_such_key(key)}")
        elif key in ranges:
            faults.append(f"--set {key}: given twice")
        else:
            ranges[key] = values
    if not sets:
        faults.append("sweep what? give --set KEY=RANGE, such as wire.diameter_mm=0.3:0.6:7")
    if faults:
        raise InputError(*faults)
    specification = load_specification(path)
    mapping = specification.model_dump(mode="json", exclude_none=True)
    coupled = specification.predicted_shape == "coupled"
    axes = _axes(ranges, lambda key: f"--set {key}")
    return SweepPlan(DesignModel(mapping, state, coupled), axes)


def _no_such_key(key: str) -> str:
    import difflib

    from sesame_cad.sweeps.designs import numeric_keys

    near = difflib.get_close_matches(key, numeric_keys(), n=1)
    hint = f"; did you mean {near[0]}?" if near else ""
    return f"no key of a specification that holds one number{hint}"
