"""Faults that lie between the keys: each is right by itself, but they do not go together."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from math import sqrt

from patterns.sewn_run import APPROACH_MM
from sesame_cad.specification.fault import Fault
from sesame_cad.specification.layout import LayoutSection
from sesame_cad.specification.machine import MachineSection
from sesame_cad.specification.outline import OutlineSection
from sesame_cad.specification.output import OutputSection
from sesame_cad.specification.stitching import StitchingSection
from sesame_cad.specification.toml_text import number_text
from sesame_cad.specification.wire import WireSection

ROUNDING = 1e-9
"""Limits met to within this (relative) are met: 25 × 2 × 0.3 may exceed 15 in the last digit."""


@dataclass(frozen=True, slots=True)
class Together:
    """The sections that are checked against each other."""

    wire: WireSection
    layout: LayoutSection
    stitching: StitchingSection
    machine: MachineSection
    outline: OutlineSection
    output: OutputSection


def inconsistencies(
    sections: Together, faulty: Collection[tuple[str, ...]] = ()
) -> tuple[Fault, ...]:
    """Check the sections against each other.

    Parameters
    ----------
    sections
        What is to go together.
    faulty
        Sections, ``("wire",)``, and keys, ``("wire", "diameter_mm")``, with a fault of their own:
        what needs them is not checked, and they need not be there.
    """
    return tuple(
        fault
        for check, needs in _CHECKS
        if not any(keys in faulty or keys[:1] in faulty for keys in needs)
        for fault in check(sections)
    )


def needed_hoop_mm(
    wire: WireSection,
    layout: LayoutSection,
    stitching: StitchingSection,
    outline: OutlineSection,
) -> tuple[float, float]:
    """Give the width and height that loops, tails, rim and registration marks take in the hoop.

    The array is centred in the hoop. The tails leave the bottom left loop at its lower left
    (225 degrees) along the tangent there, one up and to the left, one down and to the right;
    the rim of fabric goes around the wire, and the marks stand in the corners around everything.
    """
    loop, along = layout.loop_diameter_mm, stitching.tail_length_mm / sqrt(2)
    inset = loop / 2 * (1 - 1 / sqrt(2))
    rim = wire.diameter_mm / 2 + outline.margin_mm
    around = rim + stitching.mark_gap_mm + stitching.mark_size_mm + APPROACH_MM

    def whole(loops: int) -> float:
        half = loops * loop / 2
        return 2 * (max(half, half - inset + along) + around)

    return whole(layout.columns), whole(layout.rows)


def _thick_wire(sections: Together) -> Iterator[Fault]:
    loop, diameter = sections.layout.loop_diameter_mm, sections.wire.diameter_mm
    if diameter >= loop:
        limit = f"must be less than layout.loop_diameter_mm = {number_text(loop)}"
        yield Fault(_DIAMETER, limit, number_text(diameter))


def _sharp_bend(sections: Together) -> Iterator[Fault]:
    loop, diameter = sections.layout.loop_diameter_mm, sections.wire.diameter_mm
    limit = sections.stitching.smallest_bend_diameters
    smallest = 2 * limit * diameter
    if diameter < loop < smallest * (1 - ROUNDING):
        yield Fault(
            _LOOP,
            f"must be at least {smallest:.6g}: a smaller loop bends wire of "
            f"{number_text(diameter)} mm to a radius below "
            f"stitching.smallest_bend_diameters = {number_text(limit)} times its diameter",
            number_text(loop),
        )


def _small_hoop(sections: Together) -> Iterator[Fault]:
    machine = sections.machine
    width, height = needed_hoop_mm(
        sections.wire, sections.layout, sections.stitching, sections.outline
    )
    for keys, needed, available, loops in (
        (_WIDTH, width, machine.hoop_width_mm, "layout.columns"),
        (_HEIGHT, height, machine.hoop_height_mm, "layout.rows"),
    ):
        if needed > available * (1 + ROUNDING):
            yield Fault(
                keys,
                f"must be at least {needed:.1f} for the loops, tails and marks; "
                f"take a larger hoop, or fewer ({loops}) or smaller loops",
                number_text(available),
            )


def _thick_preview(sections: Together) -> Iterator[Fault]:
    thickness, diameter = sections.output.preview_thickness_mm, sections.wire.diameter_mm
    if thickness is not None and thickness > diameter:
        limit = f"must be at most wire.diameter_mm = {number_text(diameter)}"
        yield Fault(_PREVIEW, limit, number_text(thickness))


_DIAMETER = ("wire", "diameter_mm")
_LOOP = ("layout", "loop_diameter_mm")
_WIDTH = ("machine", "hoop_width_mm")
_HEIGHT = ("machine", "hoop_height_mm")
_PREVIEW = ("output", "preview_thickness_mm")

_CHECKS: tuple[tuple[Callable[[Together], Iterator[Fault]], tuple[tuple[str, str], ...]], ...] = (
    (_thick_wire, (_DIAMETER, _LOOP)),
    (_sharp_bend, (_DIAMETER, _LOOP, ("stitching", "smallest_bend_diameters"))),
    (
        _small_hoop,
        (
            _DIAMETER,
            _LOOP,
            _WIDTH,
            _HEIGHT,
            ("layout", "rows"),
            ("layout", "columns"),
            ("stitching", "tail_length_mm"),
            ("stitching", "mark_size_mm"),
            ("stitching", "mark_gap_mm"),
            ("outline", "margin_mm"),
        ),
    ),
    (_thick_preview, (_DIAMETER, _PREVIEW)),
)
"""Each check with the keys that it needs."""
