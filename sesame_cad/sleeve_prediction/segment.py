"""From a specification to the segment that is solved: one beam with its two sleeves."""

from __future__ import annotations

from math import radians

from sesame_cad.errors import InputError
from sesame_cad.omissions import loop_mass_kg
from sesame_cad.specification import Specification
from sesame_cad.specification.layout import SLEEVE
from sesame_cad.state import loop_materials
from solver.errors import SceneError
from solver.reading import Reading
from solver.sleeve.cell import SleeveCell
from solver.sleeve.scene import BeamSegment
from solver.sleeve.segment import SegmentPrediction, predict_segment
from solver.strip.scene import StripScene


def beam_segment(spec: Specification) -> BeamSegment:
    """Give a specification's segment in SI units.

    A stripe is as long as the loop is wide in the hoop, where it is sewn.

    Raises
    ------
    SceneError
        When its numbers lie outside the model.
    """
    beam, place = spec.beam, spec.sleeve_place
    ends = (place.start_mm - beam.hole_end_mm, place.end_mm - beam.hole_end_mm)
    begin, end = (share / beam.segment_mm for share in ends)
    middle = 0.5
    covered = (begin, min(end, middle)) if begin < middle - end / 2 else (max(begin, middle), end)
    strip = StripScene(
        length_m=beam.segment_mm / 1e3,
        constraint_m=beam.chord_mm / 1e3,
        width_m=beam.width_mm / 1e3,
        thickness_m=beam.thickness_mm / 1e3,
        modulus_Pa=beam.modulus_GPa * 1e9,
        poisson=beam.poisson,
        density_kg_m3=beam.density_g_cm3 * 1e3,
        covered=covered,
    )
    cell = SleeveCell(
        materials=loop_materials(spec, spec.wire.modulus_cold_GPa),
        strain=spec.fabric.prestrain,
        poisson=spec.fabric.poisson,
        reading=Reading(spec.model.reading),
        stripe_m=spec.layout.diameter_mm / 1e3,
    )
    columns = spec.layout.columns or 1
    return BeamSegment(
        strip=strip,
        cell=cell,
        loops=columns,
        hot_modulus_Pa=spec.wire.modulus_hot_GPa * 1e9,
        fabric_thickness_m=spec.fabric.thickness_mm / 1e3,
        constraint_width_m=2 * beam.constraint_rail_mm / 1e3,
        constraint_thickness_m=beam.thickness_mm / 1e3,
        sleeves_kg=2 * columns * loop_mass_kg(spec),
        tie_angle_rad=radians(spec.sleeve.tie_angle_deg),
    )


def predict_sleeve(spec: Specification) -> SegmentPrediction:
    """Predict what the sleeves of a specification do to one beam.

    Raises
    ------
    InputError
        When the layout has no sleeves, or they cannot work as specified.
    NotConvergedError
        When there is no shape to rely on.
    """
    if spec.layout.kind != SLEEVE:
        raise InputError(
            f'{spec.name}: layout.kind = "{spec.layout.kind}": must be "{SLEEVE}", '
            "the only kind with beams"
        )
    try:
        return predict_segment(beam_segment(spec))
    except SceneError as error:
        raise InputError(f"{spec.name}: {error}") from None
