"""The numbers of beams with sleeves as plain data: what `design.json` holds."""

from __future__ import annotations

from typing import Any

from patterns.cut_order import travel_mm
from patterns.cut_piece import CutPiece
from patterns.rivets import RivetHoles
from sesame_cad.design_data import FORMAT_VERSION, circuit_data, machine_data, stitch_data
from sesame_cad.electrics_data import circuits_data, electrics_data
from sesame_cad.files.stitch_formats import LOSSES
from sesame_cad.pipeline import Design
from sesame_cad.sleeve.cutting import Cutting, Sheet
from sesame_cad.sleeve.design import SleeveDesign
from sesame_cad.sleeve.hold import Hold
from sesame_cad.sleeve_prediction.data import bistable_data, sleeve_data
from sesame_cad.specification import Specification
from sesame_cad.specification.beam import BeamSection

Data = dict[str, Any]


def sleeve_design_data(design: SleeveDesign, files: dict[str, Data]) -> Data:
    """Everything in `design.json` of a design of sleeves.

    Parameters
    ----------
    files : dict
        Size and hash of each file by its path in the design's folder.
    """
    spec, found = design.spec, design.prediction
    return {
        "format": FORMAT_VERSION,
        "name": spec.name,
        "strain": spec.fabric.prestrain,
        "poisson": spec.fabric.poisson,
        "reading": spec.model.reading,
        "beams": beams_data(spec, design.pattern.cutting) | {"hold": _hold_data(design.hold)},
        "sleeve": None if found is None else sleeve_data(found),
        "bistable": None if found is None else bistable_data(found),
        "hoopings": {
            name: _hooping_data(design, name, made) for name, made in design.hoopings.items()
        },
        "upper_hoop": {
            "inside_mm": list(design.hoop.inside_mm),
            "outside_mm": list(design.hoop.outside_mm),
        },
        "losses": {kind: list(LOSSES[kind]) for kind in spec.output.formats},
        "specification": spec.model_dump(mode="json"),
        "files": files,
    }


def _hooping_data(design: SleeveDesign, name: str, made: Design) -> Data:
    """Keys of one layer: the same as those of an array."""
    spec, laid = design.spec, made.pattern
    return {
        "circuit": circuit_data(spec, laid),
        "circuits": circuits_data(spec, laid),
        "electrics": _electrics_data(spec, made),
        "stitch": stitch_data(laid.plan, design.records[name])
        | machine_data(spec.machine, laid.plan),
        "outline": {
            "pieces": len(laid.outline.outsides),
            "openings": len(laid.outline.openings),
            "margin_mm": spec.outline.margin_mm,
        },
    }


def _electrics_data(spec: Specification, made: Design) -> Data:
    """Keys of the supply; rows need not be heated at the same time, which is no warning here."""
    data = electrics_data(spec, made.pattern)
    return data | {"warnings": [one for one in data["warnings"] if "same time" not in one]}


def beams_data(spec: Specification, made: Cutting) -> Data:
    """Keys of what is cut from plastic; places along a strip are from its left end."""
    beam, strip, place = made.beam, made.constraint, spec.sleeve_place
    return {
        "count": made.count,
        "length_mm": beam.length_mm,
        "width_mm": beam.width_mm,
        "thickness_mm": spec.beam.thickness_mm,
        **_holes_data(beam.rivets),
        "hooks_mm": [place.start_mm, place.end_mm],
        "hook_height_mm": beam.hook_height_mm,
        "pitch_mm": spec.layout.pitch_of_rows_mm,
        "mass_g": _mass_g(beam.piece(), spec.beam),
        "constraint": {
            "count": made.count,
            "length_mm": strip.length_mm,
            "width_mm": strip.width_mm,
            "window_mm": strip.window_mm,
            **_holes_data(strip.rivets),
            "mass_g": _mass_g(strip.piece(), spec.beam),
        },
        "frame": _frame_data(made.laid[0], spec.beam) if spec.beam.frame_tabs else None,
        "mat": spec.beam.mat,
        "sheets": {sheet.name: _sheet_data(sheet) for sheet in made.sheets},
    }


def _hold_data(hold: Hold | None) -> Data | None:
    """Keys of how hooks hold the predicted sleeve."""
    if hold is None:
        return None
    return {
        "hook_reach_mm": hold.reach_mm,
        "tie_from_axis_mm": {"cold": hold.cold_mm, "hot": hold.hot_mm},
        "both_sides_hot": hold.hot_too,
    }


def _holes_data(rivets: RivetHoles) -> Data:
    return {
        "hole_diameter_mm": rivets.diameter_mm,
        "hole_positions_mm": list(rivets.positions_mm),
    }


def _frame_data(frame: CutPiece, beam: BeamSection) -> Data:
    return {"size_mm": list(frame.size_mm), "mass_with_beams_g": _mass_g(frame, beam)}


def _mass_g(piece: CutPiece, beam: BeamSection) -> float:
    return piece.mass_g(beam.thickness_mm, beam.density_g_cm3)


def _sheet_data(sheet: Sheet) -> Data:
    mat = sheet.nested.mat
    return {
        "size_mm": [mat.width_mm, mat.height_mm],
        "pieces": [piece.name for piece in sheet.nested.pieces],
        "cuts": len(sheet.cuts),
        "travel_mm": round(travel_mm(sheet.cuts), 3),
    }
