"""Faults of sleeves: rows, beams and hooks that do not go together, and keys that sleeves lack."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import cos, radians
from types import MappingProxyType

from patterns.couching import needle_clearance_mm
from patterns.frame_tabs import Frame
from patterns.machine import Machine
from patterns.nest_rules import fits
from patterns.stitching import Stitching
from sesame_cad.specification.beam import BeamSection
from sesame_cad.specification.fault import Fault
from sesame_cad.specification.layout import SLEEVE, LayoutSection
from sesame_cad.specification.section import Section
from sesame_cad.specification.sleeve import SleeveSection
from sesame_cad.specification.toml_text import number_text, toml_value
from sesame_cad.specification.wiring import WiringSection

ROUNDING = 1e-9
"""Limits met to within this (relative) are met."""

_ALLOWED: Mapping[tuple[str, str], tuple[object, ...]] = MappingProxyType(
    {
        ("layout", "terminals"): ("corner", "left", "right"),
        ("layout", "between"): ("cut",),
        ("layout", "shape"): ("auto", "none"),
        ("layout", "axis_ratio"): (1.0,),
        ("layout", "missing"): ((),),
        ("wiring", "split"): ("none",),
        ("stitching", "stripes"): ("none", "columns"),
        ("stitching", "ties"): ("none",),
    }
)
"""Values that keys of other sections may have in sleeves."""


def misplaced(layout: LayoutSection, beam: BeamSection, sleeve: SleeveSection) -> Iterator[Fault]:
    """Find what belongs to sleeves only, in other layouts."""
    if layout.kind == SLEEVE:
        return
    beside = f'must be left out for layout.kind = "{layout.kind}": it belongs to "{SLEEVE}"'
    if layout.row_pitch_mm:
        yield Fault(("layout", "row_pitch_mm"), beside, number_text(layout.row_pitch_mm))
    for name, section in (("beam", beam), ("sleeve", sleeve)):
        changed = [key for key in type(section).model_fields if _changed(section, key)]
        if changed:
            yield Fault((name,), f"{beside} (given: {', '.join(changed)})")


def _changed(section: Section, key: str) -> bool:
    default = type(section).model_fields[key].default
    return getattr(section, key, default) != default


def unsuitable(sections: Mapping[str, Section], wiring: WiringSection) -> Iterator[Fault]:
    """Find settings of other layouts that sleeves cannot have."""
    for (name, key), allowed in _ALLOWED.items():
        value = getattr(sections[name], key)
        if value not in allowed:
            listed = " or ".join(toml_value(one) for one in allowed)
            problem = f'must be {listed} for layout.kind = "{SLEEVE}"'
            yield Fault((name, key), problem, toml_value(value))
    if wiring.circuits:
        problem = f'must be left out for layout.kind = "{SLEEVE}": each row is a circuit'
        yield Fault(("wiring", "circuits"), problem)


def beam_faults(layout: LayoutSection, beam: BeamSection, sleeve: SleeveSection) -> Iterator[Fault]:
    """Find holes off the strips, a constraint that does not bend the beam, a sleeve too long."""
    yield from _hole_faults(beam)
    if beam.constraint_length_mm >= beam.length_mm:
        problem = f"must be less than beam.length_mm = {number_text(beam.length_mm)}"
        shown = number_text(beam.constraint_length_mm)
        yield Fault(("beam", "constraint_length_mm"), problem, shown)
    rows = layout.rows or 1
    if rows % sleeve.rows_joined:
        problem = f"must divide layout.rows = {rows}: all circuits are of equally many rows"
        yield Fault(("sleeve", "rows_joined"), problem, str(sleeve.rows_joined))
    columns, loop = layout.columns or 1, layout.loop_diameter_mm
    begin, end = beam.sleeve_room_mm
    room = end - begin
    if room <= 0:
        problem = (
            f"must be greater than {2 * begin:.6g}: hole and hook leave no room for a sleeve on "
            "one half of the beam"
        )
        yield Fault(("beam", "length_mm"), problem, number_text(beam.length_mm))
        return
    pitch = sleeve.pitch_mm(layout, beam)
    keys, shown = ("sleeve", "compressed_pitch_mm"), number_text(sleeve.compressed_pitch_mm)
    if columns * pitch > room * (1 + ROUNDING):
        problem = (
            f"must be at most {room / columns:.6g}: the compressed sleeve of {columns} loops must "
            f"fit on half of the beam, where hole and hook leave {room:.6g} mm"
        )
        yield Fault(keys, problem, shown)
    elif loop is not None and pitch >= loop:
        problem = f"must be less than layout.loop_diameter_mm = {number_text(loop)}"
        if not sleeve.compressed_pitch_mm:
            problem = (
                f"is {pitch:.6g} when it is left out, as half of the beam has room for, and "
                f"{problem}: give it, or take a shorter beam"
            )
            shown = None
        yield Fault(keys, problem, shown)


def _hole_faults(beam: BeamSection) -> Iterator[Fault]:
    hole, beside = number_text(beam.hole_diameter_mm), number_text(beam.hole_edge_diameters)
    why = f"for holes of beam.hole_diameter_mm = {hole} with {beside} diameters beside them"
    for keys, value, least in (
        ("width_mm", beam.width_mm, 2 * beam.hole_end_mm),
        ("constraint_length_mm", beam.constraint_length_mm, _shortest_constraint_mm(beam)),
        ("length_mm", beam.length_mm, _shortest_mm(beam)),
    ):
        if value < least * (1 - ROUNDING):
            yield Fault(("beam", keys), f"must be at least {least:.6g} {why}", number_text(value))
    if 2 * beam.corner_radius_mm > beam.width_mm:
        problem = f"must be at most {beam.width_mm / 2:.6g}, half of beam.width_mm"
        shown = number_text(beam.corner_radius_mm)
        yield Fault(("beam", "corner_radius_mm"), problem, shown)


def _shortest_mm(beam: BeamSection) -> float:
    """Length of a strip on which two holes have their room."""
    return 2 * beam.hole_end_mm + beam.hole_diameter_mm + beam.limits.web_mm


def _shortest_constraint_mm(beam: BeamSection) -> float:
    """Length of a constraint strip with a window between its ends."""
    return 4 * beam.hole_end_mm + max(2 * beam.corner_radius_mm, beam.limits.web_mm)


def tie_faults(
    layout: LayoutSection,
    beam: BeamSection,
    sleeve: SleeveSection,
    *,
    machine: Machine,
    stitching: Stitching,
    wire_diameter_mm: float,
) -> Iterator[Fault]:
    """Find ties that would meet wire, beams or the frame."""
    clear = needle_clearance_mm(wire_diameter_mm, machine, stitching)
    least = 2 * (clear + stitching.lock_length_mm)
    if sleeve.tie_length_mm < least * (1 - ROUNDING):
        problem = (
            f"must be at least {least:.6g}: wire, needle, margin and the lock of "
            f"stitching.lock_length_mm = {number_text(stitching.lock_length_mm)} on both sides"
        )
        yield Fault(("sleeve", "tie_length_mm"), problem, number_text(sleeve.tie_length_mm))
        return
    loop = layout.diameter_mm
    tilt = cos(radians(sleeve.tie_angle_deg))
    half, around = sleeve.tie_length_mm / 2, machine.needle_diameter_mm / 2
    inner = (loop / 2 - half) * tilt - around - sleeve.needle_to_beam_mm
    if inner < beam.reach_mm * (1 - ROUNDING):
        problem = (
            f"must be at most {max(0.0, 2 * (inner - beam.hook_height_mm)):.6g} for ties inside "
            f"loops of {number_text(loop)} mm that clear its hooks by sleeve.needle_to_beam_mm = "
            f"{number_text(sleeve.needle_to_beam_mm)}; or take larger loops"
        )
        yield Fault(("beam", "width_mm"), problem, number_text(beam.width_mm))
    outer = (loop / 2 + half) * tilt + around + sleeve.needle_to_beam_mm
    pitch = layout.pitch_of_rows_mm
    least = 2 * outer if beam.frame_tabs else outer + beam.reach_mm
    least = max(least, loop + 2 * (half + around))
    if pitch < least * (1 - ROUNDING):
        problem = f"must be at least {least:.6g}: ties must clear those of the next row and beams"
        shown = number_text(layout.row_pitch_mm)
        yield Fault(("layout", "row_pitch_mm"), problem, shown)


def sheet_faults(layout: LayoutSection, beam: BeamSection, sewn_mm: float) -> Iterator[Fault]:
    """Find strips that are larger than the sheet; rows are ``sewn_mm`` wide with their fabric."""
    mat = beam.sheet
    width, height = mat.room_mm
    for what, across, up in _largest_pieces(layout, beam, sewn_mm):
        if not fits(mat.room_mm, across, up) and not fits(mat.room_mm, up, across):
            yield Fault(
                ("beam", "mat"),
                f"too small: {what} of {across:.6g} x {up:.6g} mm must fit on {width:.6g} x "
                f"{height:.6g} mm between its margins",
                f'"{beam.mat}"',
            )


def _largest_pieces(
    layout: LayoutSection, beam: BeamSection, sewn_mm: float
) -> Iterator[tuple[str, float, float]]:
    """Name, length and width of the pieces that must fit on the sheet, as they shall come out."""
    kerf = beam.kerf_mm
    if beam.frame_tabs:
        width, height = Frame(layout.pitch_of_rows_mm).size_mm(beam.length_mm, layout.rows or 1)
        yield "the frame with all beams", width + kerf, height + kerf
    else:
        yield "a beam", beam.length_mm + kerf, 2 * beam.reach_mm + kerf
    width = beam.window_mm(sewn_mm) + 2 * beam.constraint_rail_mm
    yield "a constraint strip", beam.constraint_length_mm + kerf, width + kerf
