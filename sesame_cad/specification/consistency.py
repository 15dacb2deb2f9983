"""Faults that lie between the keys: each is right by itself, but they do not go together."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from math import cos, sin

from patterns.errors import PatternError
from patterns.sewn_run import APPROACH_MM
from patterns.terminals import terminals
from sesame_cad.specification.beam import BeamSection
from sesame_cad.specification.fault import Fault
from sesame_cad.specification.layout import SLEEVE, LayoutSection
from sesame_cad.specification.machine import MachineSection
from sesame_cad.specification.model import ModelSection
from sesame_cad.specification.outline import OutlineSection
from sesame_cad.specification.output import OutputSection
from sesame_cad.specification.prediction import MOST_COUPLED, coupled_because, predicted_shape
from sesame_cad.specification.sleeve import SleeveSection, sewn_width_mm
from sesame_cad.specification.sleeve_faults import (
    beam_faults,
    misplaced,
    sheet_faults,
    tie_faults,
    unsuitable,
)
from sesame_cad.specification.stitching import StitchingSection
from sesame_cad.specification.toml_text import number_text
from sesame_cad.specification.wire import WireSection
from sesame_cad.specification.wiring import WiringSection
from sesame_cad.specification.wiring_faults import circuit_faults

ROUNDING = 1e-9
"""Limits met to within this (relative) are met: 25 × 2 × 0.3 may exceed 15 in the last digit."""


@dataclass(frozen=True, slots=True)
class Together:
    """The sections that are checked against each other."""

    wire: WireSection
    layout: LayoutSection
    model: ModelSection
    wiring: WiringSection
    stitching: StitchingSection
    machine: MachineSection
    outline: OutlineSection
    output: OutputSection
    beam: BeamSection
    sleeve: SleeveSection


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
        if fault.keys not in faulty
    )


def needed_hoop_mm(
    wire: WireSection,
    layout: LayoutSection,
    stitching: StitchingSection,
    outline: OutlineSection,
) -> tuple[float, float]:
    """Give the width and height that loops, tails, rim and registration marks take in the hoop.

    The array is centred in the hoop. The tails leave one loop on its tangent, to both sides; the
    rim of fabric goes around the wire, and the marks stand in the corners around everything.

    Raises
    ------
    PatternError
        When the tails cannot leave on the side that is asked for.
    """
    loops = layout.loops()
    start, angle = terminals(loops, layout.side)
    rim = wire.diameter_mm / 2 + outline.margin_mm
    around = rim + stitching.mark_gap_mm + stitching.mark_size_mm + APPROACH_MM
    left, bottom, right, top = zip(*(loop.box_mm() for loop in loops), strict=True)
    x, y = loops[start].point_mm(angle)
    tail = stitching.tail_length_mm

    def whole(low: float, high: float, terminal: float, along: float) -> float:
        return 2 * (max(-low, high, abs(terminal) + abs(tail * along)) + around)

    return (
        whole(min(left), max(right), x, sin(angle)),
        whole(min(bottom), max(top), y, cos(angle)),
    )


def _missing_keys(sections: Together) -> Iterator[Fault]:
    layout = sections.layout
    row = (_DIAMETERS,) if layout.diameters_mm else (_COLUMNS, _LOOP)
    needed = {"row": row, "circles": (_CIRCLES,)}.get(layout.kind, (_ROWS, _COLUMNS, _LOOP))
    for keys in _ARRANGING:
        given = getattr(layout, keys[1])
        what = LayoutSection.model_fields[keys[1]].description
        if keys in needed and not given:
            yield Fault(keys, f"missing; give {what}")
        elif keys not in needed and given and not (keys == _ROWS and given == 1):
            problem = f"must be left out {_beside(layout, keys)}"
            shown = number_text(given) if isinstance(given, (int, float)) else None
            yield Fault(keys, problem, shown)


def _beside(layout: LayoutSection, keys: tuple[str, str]) -> str:
    """Say why a key that arranges loops has no place."""
    kind = f'for layout.kind = "{layout.kind}"'
    if keys == _DIAMETERS and layout.kind != "circles":
        return f'{kind}, whose loops touch only when they are equal; choose "row" or "circles"'
    return "when layout.diameters_mm is given" if layout.diameters_mm else kind


def _missing_cells(sections: Together) -> Iterator[Fault]:
    layout = sections.layout
    if layout.missing and layout.kind == "circles":
        yield Fault(_MISSING, 'must be left out for layout.kind = "circles"')
        return
    cells = layout.all_cells()
    for row, column in dict.fromkeys(layout.missing):
        if (row - 1, column - 1) not in cells:
            yield Fault(_MISSING, f"there is no row {row} with a column {column} to leave out")
    if cells and not layout.cells():
        yield Fault(_MISSING, "leaves no loop at all")


def _no_shape(sections: Together) -> Iterator[Fault]:
    layout, model = sections.layout, sections.model
    if layout.kind == SLEEVE:
        return  # what it may be is said with the rest of sleeves
    coupling = coupled_because(layout, sections.wiring, sections.wire)
    if layout.shape == "cell" and coupling is not None:
        yield Fault(
            _SHAPE,
            f"cannot be had: {coupling}, which needs the coupled array solve; let it be "
            '"coupled", or "none" for stitch and cut files only',
            '"cell"',
        )
        return
    shape = predicted_shape(layout, model, sections.wiring, sections.wire)
    if layout.shape == "cell" and model.fidelity == "mesh":
        yield Fault(_FIDELITY, 'must be "compact" or "auto" for layout.shape = "cell"', '"mesh"')
    if shape == "coupled" and model.fidelity == "compact":
        problem = 'must be "mesh" or "auto": the loops\' shape is a coupled one'
        yield Fault(_FIDELITY, problem, '"compact"')
    if shape == "coupled" and layout.count > MOST_COUPLED:
        yield Fault(
            _SHAPE,
            f'must be "none" for {layout.count} loops: a coupled shape is predicted for up to '
            f"{MOST_COUPLED}",
            f'"{layout.shape}"',
        )


def _thick_wire(sections: Together) -> Iterator[Fault]:
    diameter = sections.wire.diameter_mm
    loop = min(sections.layout.known_diameters_mm, default=None)
    if loop is not None and diameter >= loop:
        limit = f"must be less than {_loop_name(sections.layout)} = {number_text(loop)}"
        yield Fault(_DIAMETER, limit, number_text(diameter))


def _sharp_bend(sections: Together) -> Iterator[Fault]:
    diameter = sections.wire.diameter_mm
    limit = sections.stitching.smallest_bend_diameters
    for loop in sections.layout.kinds_of_loops():
        smallest = loop.diameter_mm * limit * diameter / loop.smallest_radius_mm
        if diameter < loop.diameter_mm < smallest * (1 - ROUNDING):
            oval = f" with an axis ratio of {loop.axis_ratio:g}" if loop.axis_ratio != 1 else ""
            yield Fault(
                _sizes(sections.layout),
                f"must be at least {smallest:.6g}: a smaller loop{oval} bends wire of "
                f"{number_text(diameter)} mm to a radius below "
                f"stitching.smallest_bend_diameters = {number_text(limit)} times its diameter",
                number_text(loop.diameter_mm),
            )


def _sizes(layout: LayoutSection) -> tuple[str, str]:
    """Key with the sizes of the loops."""
    if layout.kind == "circles":
        return _CIRCLES
    return _DIAMETERS if layout.diameters_mm else _LOOP


def _loop_name(layout: LayoutSection) -> str:
    name = ".".join(_sizes(layout))
    return name if name.endswith(_LOOP[1]) else f"a diameter in {name}"


def _stretched_twice(sections: Together) -> Iterator[Fault]:
    layout = sections.layout
    if layout.kind == "circles" and layout.axis_ratio != 1:
        problem = 'must be left out for layout.kind = "circles": give it in each of layout.circles'
        yield Fault(_RATIO, problem, number_text(layout.axis_ratio))
    elif layout.axis_angle_deg and layout.axis_ratio == 1:
        problem = "must be left out when layout.axis_ratio is 1: circles have no direction"
        yield Fault(_ANGLE, problem, number_text(layout.axis_angle_deg))


def _small_hoop(sections: Together) -> Iterator[Fault]:
    machine, layout = sections.machine, sections.layout
    if sections.wiring.split != "none" or sections.wiring.circuits or layout.kind == SLEEVE:
        return  # where several pairs of tails leave is known when the wires are laid
    known = layout.known_diameters_mm
    if not known or min(known) <= sections.wire.diameter_mm or not layout.loops():
        return  # that is said elsewhere
    try:
        width, height = needed_hoop_mm(sections.wire, layout, sections.stitching, sections.outline)
    except PatternError:
        return  # said when the wire is laid, after what may be wrong with the loops
    rims = 2 * machine.hoop_rim_mm
    for keys, needed, available, loops in (
        (_WIDTH, width + rims, machine.hoop_width_mm, "layout.columns"),
        (_HEIGHT, height + rims, machine.hoop_height_mm, "layout.rows"),
    ):
        if needed > available * (1 + ROUNDING):
            yield Fault(
                keys,
                f"must be at least {needed:.1f} for the loops, margin, tails and marks; "
                f"take a larger hoop, or fewer ({loops}) or smaller loops",
                number_text(available),
            )


def _thick_preview(sections: Together) -> Iterator[Fault]:
    thickness, diameter = sections.output.preview_thickness_mm, sections.wire.diameter_mm
    if thickness is not None and thickness > diameter:
        limit = f"must be at most wire.diameter_mm = {number_text(diameter)}"
        yield Fault(_PREVIEW, limit, number_text(thickness))


def _misplaced(sections: Together) -> Iterator[Fault]:
    return misplaced(sections.layout, sections.beam, sections.sleeve)


def _sleeves(sections: Together) -> Iterator[Fault]:
    layout, beam = sections.layout, sections.beam
    if layout.kind != SLEEVE:
        return
    others = {"layout": layout, "wiring": sections.wiring, "stitching": sections.stitching}
    yield from unsuitable(others, sections.wiring)
    if not layout.loop_diameter_mm or sections.wire.diameter_mm >= layout.loop_diameter_mm:
        return  # which is said elsewhere
    wire_mm = sections.wire.diameter_mm
    sewn_mm = sewn_width_mm(layout.diameter_mm, wire_mm, sections.outline.margin_mm)
    found = [*beam_faults(layout, beam, sections.sleeve), *sheet_faults(layout, beam, sewn_mm)]
    yield from found
    if not found:
        yield from tie_faults(
            layout,
            beam,
            sections.sleeve,
            machine=sections.machine.geometry(),
            stitching=sections.stitching.geometry(),
            wire_diameter_mm=wire_mm,
        )


_DIAMETER = ("wire", "diameter_mm")
_KIND = ("layout", "kind")
_ROWS = ("layout", "rows")
_COLUMNS = ("layout", "columns")
_LOOP = ("layout", "loop_diameter_mm")
_DIAMETERS = ("layout", "diameters_mm")
_RATIO = ("layout", "axis_ratio")
_RATIO_NAME = ".".join(_RATIO)
_ANGLE = ("layout", "axis_angle_deg")
_MISSING = ("layout", "missing")
_CIRCLES = ("layout", "circles")
_TERMINALS = ("layout", "terminals")
_SHAPE = ("layout", "shape")
_FIDELITY = ("model", "fidelity")
_WIDTH = ("machine", "hoop_width_mm")
_HEIGHT = ("machine", "hoop_height_mm")
_RIM = ("machine", "hoop_rim_mm")
_PREVIEW = ("output", "preview_thickness_mm")

_NEEDLE = (
    ("machine", "needle_diameter_mm"),
    ("stitching", "needle_margin_mm"),
    ("stitching", "lock_length_mm"),
)

_ARRANGING = (_ROWS, _COLUMNS, _LOOP, _DIAMETERS, _CIRCLES)
_SIZES = (_KIND, _LOOP, _DIAMETERS, _CIRCLES)

_CHECKS: tuple[tuple[Callable[[Together], Iterator[Fault]], tuple[tuple[str, str], ...]], ...] = (
    (_missing_keys, (_KIND, _DIAMETERS)),
    (_missing_cells, (_KIND, _ROWS, _COLUMNS, _DIAMETERS, _MISSING)),
    (
        _no_shape,
        (
            _KIND,
            _ROWS,
            _COLUMNS,
            _DIAMETERS,
            _RATIO,
            _MISSING,
            _CIRCLES,
            _SHAPE,
            ("layout", "between"),
            ("wiring", "circuits"),
            _DIAMETER,
            ("wire", "modulus_cold_GPa"),
            ("wire", "modulus_hot_GPa"),
            _FIDELITY,
        ),
    ),
    (_thick_wire, (_DIAMETER, *_SIZES)),
    (_sharp_bend, (_DIAMETER, *_SIZES, _RATIO, ("stitching", "smallest_bend_diameters"))),
    (_stretched_twice, (_KIND, _RATIO, _ANGLE)),
    (
        _small_hoop,
        (
            _DIAMETER,
            *_SIZES,
            _ROWS,
            _COLUMNS,
            _RATIO,
            _ANGLE,
            _MISSING,
            _TERMINALS,
            _WIDTH,
            _HEIGHT,
            _RIM,
            ("stitching", "tail_length_mm"),
            ("stitching", "mark_size_mm"),
            ("stitching", "mark_gap_mm"),
            ("outline", "margin_mm"),
        ),
    ),
    (_thick_preview, (_DIAMETER, _PREVIEW)),
    (_misplaced, (_KIND, ("layout", "row_pitch_mm"))),
    (
        _sleeves,
        (
            _KIND,
            _ROWS,
            _COLUMNS,
            _LOOP,
            _DIAMETER,
            ("layout", "row_pitch_mm"),
            *(("beam", key) for key in BeamSection.model_fields),
            *(("sleeve", key) for key in SleeveSection.model_fields),
            *_NEEDLE,
        ),
    ),
    (
        lambda sections: circuit_faults(sections.wiring, sections.layout, sections.stitching),
        (("wiring", "circuits"), ("wiring", "split"), _KIND, _ROWS, _COLUMNS, _MISSING, _SHAPE),
    ),
)
"""Each check with the keys that it needs."""
