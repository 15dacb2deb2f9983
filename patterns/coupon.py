"""A coupon to find the settings for a wire: cells along one wire, each sewn in another way."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from patterns.circuit import Circuit
from patterns.couching import (
    FREE_TAIL_MM,
    LEFT,
    alternate_sides,
    couching,
    needle_clearance_mm,
    needle_points,
)
from patterns.coupon_labels import label_marks
from patterns.coupon_wire import CouponWire, coupon_wire
from patterns.cover import covers
from patterns.errors import PatternError
from patterns.instructions import Instructions, with_thread
from patterns.laid_wire import laid_wire
from patterns.locks import POINTS_PER_LOCK, sides_with_locks, with_locks
from patterns.machine import Machine
from patterns.mark_stitches import mark_stitches
from patterns.path import Vectors
from patterns.plan import Block, BlockKind, StitchPlan
from patterns.registration import Mark
from patterns.sewn_run import thread_run, wire_run
from patterns.stations import ROUND_OFF
from patterns.stitching import Stitching

RowName = Literal["width", "interval", "cover"]

MARGINS_MM = (0.1, 0.15, 0.2, 0.3, 0.4, 0.5)
INTERVALS_MM = (1.0, 1.5, 2.0, 3.0, 4.0, 5.0)
USUAL_INTERVALS_MM = (1.5, 4.0)
"""Between these, wire is tied down in tailored fibre placement."""

MOST_STEPS = len(MARGINS_MM)
FEWEST_STEPS = 2
LEAST_RADIUS_MM = 8.0

LABELS_TEXT = (
    "a thread that stands out against the fabric: letters of the rows (W couching "
    "width, I interval, C cover width) and numbers of the cells."
)


@dataclass(frozen=True, slots=True)
class Cell:
    """One setting, sewn in one place.

    Attributes
    ----------
    row : str
        What changes along the row.
    number : int
        From 1, as it is stitched beside the cell.
    margin_mm, interval_mm : float
        Free space between needle and wire, and distance of stitches along the wire.
    x_mm, y_mm : float
        Middle of the cell.
    usual : bool
        Whether the setting is within what the machine's settings and the rules advise.
    """

    row: RowName
    number: int
    margin_mm: float
    interval_mm: float
    x_mm: float
    y_mm: float
    usual: bool


@dataclass(frozen=True)
class Coupon:
    """A coupon, planned; ``stitching`` holds the loosest settings that occur, for the rules."""

    circuit: Circuit
    cells: tuple[Cell, ...]
    marks: tuple[Mark, ...]
    plan: StitchPlan
    stitching: Stitching


def coupon(machine: Machine, stitching: Stitching, wire_diameter_mm: float) -> Coupon:
    """Plan a coupon as long as the machine's field is wide.

    One wire runs to and fro. Along its first straight line couching gets wider from cell to cell,
    along its second the stitches get farther apart, and the third it crosses in waves on its way
    back, over covers of more and more width.

    Raises
    ------
    PatternError
        When the field has no room, the head swings its needle, or as `patterns.stitch_plan`.
    """
    if machine.couching != "zigzag":
        raise PatternError(
            'a coupon steps the needle\'s way over the wire, which machine.couching = "centreline" '
            "leaves to the head: find its swing by hand, then make the coupon with zigzag"
        )
    wire = _fitting(machine, stitching, wire_diameter_mm)
    cells = _cells(wire, stitching)
    marks = label_marks([(cell.row, cell.number, cell.x_mm, cell.y_mm) for cell in cells], wire)
    plan = _Sewing(wire, cells, machine, stitching, wire_diameter_mm).plan(marks)
    loosest = replace(
        stitching,
        cover_margin_mm=MARGINS_MM[0],
        couching_interval_mm=max(cell.interval_mm for cell in cells),
    )
    return Coupon(wire.circuit, cells, marks, plan, loosest)


def _fitting(machine: Machine, stitching: Stitching, wire_diameter_mm: float) -> CouponWire:
    radius = max(LEAST_RADIUS_MM, stitching.smallest_bend_diameters * wire_diameter_mm)
    width, height = machine.field_mm
    for steps in range(MOST_STEPS, FEWEST_STEPS - 1, -2):
        wire = coupon_wire(radius, steps)
        if wire.width_mm <= width and wire.height_mm <= height:
            return wire
    least = coupon_wire(radius, FEWEST_STEPS)
    raise PatternError(
        f"the field of {width:g} x {height:g} mm has no room for a coupon: bends of {radius:g} mm "
        f"radius need {least.width_mm:.0f} x {least.height_mm:.0f} mm"
    )


def _cells(wire: CouponWire, stitching: Stitching) -> tuple[Cell, ...]:
    """Give the cells, row by row, in the order of the values."""
    own_margin, own_interval = stitching.needle_margin_mm, stitching.couching_interval_mm
    cells: list[Cell] = []
    picked = np.linspace(0, MOST_STEPS - 1, wire.steps).round().astype(int).tolist()
    low, high = USUAL_INTERVALS_MM
    for number, step in enumerate(picked, start=1):
        margin, interval = MARGINS_MM[step], INTERVALS_MM[step]
        wide, usual = margin >= own_margin, low <= interval <= high
        at = {row: wire.cell_mm(row, number) for row in ("width", "interval", "cover")}
        cells += [
            Cell("width", number, margin, own_interval, *at["width"], wide),
            Cell("interval", number, own_margin, interval, *at["interval"], usual),
            Cell("cover", number, margin, own_interval, *at["cover"], wide),
        ]
    return tuple(sorted(cells, key=lambda cell: -cell.y_mm))


@dataclass(frozen=True)
class _Sewing:
    """A coupon's wire and cells, and what they are sewn with."""

    wire: CouponWire
    cells: tuple[Cell, ...]
    machine: Machine
    stitching: Stitching
    wire_diameter_mm: float

    def plan(self, marks: tuple[Mark, ...]) -> StitchPlan:
        """Labels, first stage, covers, second stage."""
        circuit, machine = self.wire.circuit, self.machine
        satin = self._covers()
        say = Instructions(circuit, (self.wire_diameter_mm,) * 2, machine, [satin])
        labels = tuple(
            thread_run(run, machine)
            for mark in marks
            for run in mark_stitches(mark, self.stitching.lock_length_mm)
        )
        covered = tuple(thread_run(points, machine) for points in satin)
        first, second = wire_run(self._stepped(), machine), wire_run(self._waves(), machine)
        return StitchPlan(
            (
                Block(BlockKind.MARKS, with_thread(machine, LABELS_TEXT), labels),
                Block(BlockKind.WIRE, say.wire(0), (first,), 0),
                Block(BlockKind.COVER, say.cover(1), covered, 1),
                Block(BlockKind.WIRE, say.wire(1), (second,), 1),
            )
        )

    @property
    def _narrow(self) -> Stitching:
        """The settings with the smallest margin that occurs."""
        least = min(MARGINS_MM[0], self.stitching.needle_margin_mm)
        return replace(self.stitching, needle_margin_mm=least)

    def _clear_mm(self, stitching: Stitching) -> float:
        return needle_clearance_mm(self.wire_diameter_mm, self.machine, stitching)

    def _row(self, row: RowName) -> dict[int, Cell]:
        return {cell.number: cell for cell in self.cells if cell.row == row}

    def _stepped(self) -> Vectors:
        """Tie down the first stage, each stretch in its own way."""
        stitching, narrow = self.stitching, self._narrow
        path = self.wire.circuit.stages[0]
        bend = np.radians(stitching.couching_angle_deg) * self.wire.radius_mm
        stations, wider = [np.array([FREE_TAIL_MM])], [np.zeros(1)]
        for begin, end, (row, number) in self.wire.stretches:
            interval, margin = min(stitching.couching_interval_mm, bend), stitching.needle_margin_mm
            if row == "width":
                margin = self._row("width")[number].margin_mm
            own = np.linspace(begin, end, int(np.ceil((end - begin) / interval - ROUND_OFF)) + 1)
            if row == "interval":
                exact = self._row("interval")[number].interval_mm
                own = np.append(begin + exact * np.arange(np.ceil((end - begin) / exact)), end)
            stations.append(own[1:])
            wider.append(np.full(len(own) - 1, margin - narrow.needle_margin_mm))
        at = np.concatenate(stations)
        return needle_points(
            path,
            with_locks(at, stitching.lock_length_mm),
            sides_with_locks(alternate_sides(len(at))),
            laid_wire(path),
            self._clear_mm(narrow),
            wider_mm=np.pad(np.concatenate(wider), POINTS_PER_LOCK, mode="edge"),
        )

    def _covers(self) -> list[Vectors]:
        """Cover each crossing as wide as its cell has it, from the end of the wire backward."""
        circuit, row = self.wire.circuit, self._row("cover")
        laid = laid_wire(circuit.stages[0])
        sewn: list[Vectors] = []
        for number in sorted(row, reverse=True):
            alone = replace(circuit, crossings=circuit.crossings[number - 1 : number])
            margin = row[number].margin_mm
            sewn += covers(
                alone,
                1,
                laid,
                clear_mm=self._clear_mm(self._narrow),
                wire_diameter_mm=self.wire_diameter_mm,
                stitching=replace(self._narrow, cover_margin_mm=margin),
            )
        return sewn

    def _waves(self) -> Vectors:
        """Tie down the second stage as the settings have it."""
        path = self.wire.circuit.stages[1]
        return couching(
            path,
            (0.0, path.length_mm - FREE_TAIL_MM),
            LEFT,
            laid_wire(*self.wire.circuit.stages),
            clear_mm=self._clear_mm(self.stitching),
            stitching=self.stitching,
        )
