"""Faults of circuits that are given one by one."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from sesame_cad.specification.fault import Fault
from sesame_cad.specification.layout import LayoutSection
from sesame_cad.specification.stitching import StitchingSection
from sesame_cad.specification.toml_text import number_text
from sesame_cad.specification.wiring import CircuitItem, WiringSection

_CIRCUITS = ("wiring", "circuits")
_SPLIT = ("wiring", "split")
_MOST_NAMED = 4


def circuit_faults(
    wiring: WiringSection, layout: LayoutSection, stitching: StitchingSection
) -> Iterator[Fault]:
    """Check that circuits hold every loop once, and that their wires suit the loops."""
    circuits = wiring.circuits
    if not circuits:
        return
    if wiring.split != "none":
        yield Fault(_SPLIT, 'must be "none" when wiring.circuits is given', f'"{wiring.split}"')
    for name, count in Counter(one.name for one in circuits).items():
        if count > 1:
            yield Fault(_CIRCUITS, f"{count} circuits are called {name}: names must differ")
    wrong = [fault for one in circuits for fault in _own_faults(one, layout)]
    yield from wrong or _not_once(wiring, layout)
    yield from _wire_faults(wiring, layout, stitching)


def circuit_loops(circuit: CircuitItem, layout: LayoutSection) -> tuple[int, ...]:
    """Give the loops of a circuit by their places in the layout, in rising order."""
    if layout.kind == "circles":
        return tuple(sorted(circuit.loops))
    place = {cell: k for k, cell in enumerate(layout.cells())}
    return tuple(sorted(place[row - 1, column - 1] for row, column in circuit.cells))


def _own_faults(circuit: CircuitItem, layout: LayoutSection) -> Iterator[Fault]:
    right, wrong = ("loops", "cells") if layout.kind == "circles" else ("cells", "loops")
    if getattr(circuit, wrong):
        yield Fault(
            _CIRCUITS,
            f'circuit {circuit.name}: name its loops by {right} for layout.kind = "{layout.kind}", '
            f"not by {wrong}",
        )
    elif not getattr(circuit, right):
        yield Fault(_CIRCUITS, f"circuit {circuit.name}: it has no {right}")
    elif layout.kind == "circles":
        count = len(layout.circles)
        for loop in sorted(set(circuit.loops) - set(range(count)))[:_MOST_NAMED]:
            problem = f"there is no loop {loop}: the loops are counted from 0 to {count - 1}"
            yield Fault(_CIRCUITS, f"circuit {circuit.name}: {problem}")
    else:
        cells = {(row + 1, column + 1) for row, column in layout.cells()}
        for row, column in sorted(set(circuit.cells) - cells)[:_MOST_NAMED]:
            problem = f"there is no loop in row {row} and column {column}"
            yield Fault(_CIRCUITS, f"circuit {circuit.name}: {problem}")


def _not_once(wiring: WiringSection, layout: LayoutSection) -> Iterator[Fault]:
    """Loops in no circuit, or in several."""
    times = Counter(k for one in wiring.circuits for k in circuit_loops(one, layout))
    count = len(layout.circles) if layout.kind == "circles" else len(layout.cells())
    for what, wrong in (
        ("is in no circuit", [k for k in range(count) if not times[k]]),
        ("is in circuits more than once", [k for k in range(count) if times[k] > 1]),
    ):
        if wrong:
            more = f", and {len(wrong) - 1} more" if len(wrong) > 1 else ""
            name = _loop_name(layout, wrong[0])
            yield Fault(_CIRCUITS, f"{name} {what}{more}: every loop must be in one, once")


def _loop_name(layout: LayoutSection, loop: int) -> str:
    if layout.kind == "circles":
        return f"loop {loop}"
    row, column = layout.cells()[loop]
    return f"the loop in row {row + 1} and column {column + 1}"


def _wire_faults(
    wiring: WiringSection, layout: LayoutSection, stitching: StitchingSection
) -> Iterator[Fault]:
    limit = stitching.smallest_bend_diameters
    bends = (2 * loop.smallest_radius_mm for loop in layout.kinds_of_loops())
    smallest = min(bends, default=float("inf"))
    for one in wiring.circuits:
        diameter = one.wire_diameter_mm
        if layout.kind != "circles" and diameter and smallest < 2 * limit * diameter * (1 - 1e-9):
            yield Fault(
                _CIRCUITS,
                f"circuit {one.name}: wire_diameter_mm = {number_text(diameter)} is too thick for "
                f"loops bent like circles of {smallest:.6g} mm: it must be at most "
                f"{smallest / (2 * limit):.4g}, by "
                f"stitching.smallest_bend_diameters = {number_text(limit)}",
            )
