"""The files of beams with sleeves."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

from sesame_cad.files.cut_dxf import cut_dxf
from sesame_cad.files.cut_line import CutLine, cut_line
from sesame_cad.files.cut_svg import cut_svg
from sesame_cad.files.stl import write_stl
from sesame_cad.package_files import (
    Data,
    Files,
    Progress,
    cut_files,
    stitch_files,
    worksheet_file,
)
from sesame_cad.pictures.landscape import landscape_picture
from sesame_cad.pictures.plan import plan_picture
from sesame_cad.pictures.segment import segment_picture
from sesame_cad.pictures.sleeve_force import sleeve_force_picture
from sesame_cad.sleeve.cutting import Sheet
from sesame_cad.sleeve.data import sleeve_design_data
from sesame_cad.sleeve.design import SleeveDesign, sleeve_design
from sesame_cad.sleeve.plan import sleeve_plan_svg
from sesame_cad.sleeve_prediction.curves import force_curve_csv, force_curves
from sesame_cad.sleeve_prediction.solids import segment_solids
from sesame_cad.specification import Specification
from solver.sleeve.segment import SegmentPrediction

FORCE_FILE = "shape/sleeve-force.csv"
PREDICTED_PICTURES = ("segment", "landscape", "sleeve-force")


def sleeve_files(
    spec: Specification, progress: Progress
) -> tuple[Files, Callable[[dict[str, Data]], Data]]:
    """Design sleeves; give their files, and what `design.json` holds once these are known.

    Raises
    ------
    InputError
        When the specification asks for what cannot be made.
    NotConvergedError
        When there is no shape to rely on.
    """
    made = sleeve_design(spec, progress)
    return _files(made, progress), partial(sleeve_design_data, made)


def _files(made: SleeveDesign, progress: Progress) -> Files:
    """Every file but `design.json`, by its path in the folder."""
    name = made.spec.name
    for layer, hooping in made.hoopings.items():
        records = made.records[layer]
        progress(f"stitch files of the {layer} array")
        yield from stitch_files(hooping, records)
        yield from cut_files(hooping)
        yield worksheet_file(hooping, records)
        if made.spec.output.pictures:
            laid = hooping.pattern
            picture = plan_picture(laid.circuit, laid.plan, laid.outline, laid.marks)
            yield f"pictures/plan-{layer}.png", picture
    progress("sheets to cut")
    for sheet in made.pattern.cutting.sheets:
        yield from _sheet_files(name, sheet)
    progress("drawing of the plan")
    yield f"plan/{name}.svg", sleeve_plan_svg(made).encode()
    if made.prediction is not None:
        yield from _predicted_files(made.spec, made.prediction, progress)


def _predicted_files(spec: Specification, found: SegmentPrediction, progress: Progress) -> Files:
    """Give previews of the states, the sleeve's force, and pictures of both."""
    for part, solid in segment_solids(spec, found, progress):
        yield f"shape/{part}.stl", write_stl(solid, f"{spec.name} {part}")
    progress("force of the sleeves")
    curves = force_curves(found)
    yield FORCE_FILE, force_curve_csv(curves).encode()
    if spec.output.pictures:
        progress("pictures of the states")
        pictures = (
            segment_picture(spec, found),
            landscape_picture(found),
            sleeve_force_picture(found, curves),
        )
        for name, picture in zip(PREDICTED_PICTURES, pictures, strict=True):
            yield f"pictures/{name}.png", picture


def sheet_lines(sheet: Sheet) -> tuple[CutLine, ...]:
    """Give the lines of a sheet in the order of cutting."""
    return tuple(map(cut_line, sheet.cuts))


def _sheet_files(name: str, sheet: Sheet) -> Iterator[tuple[str, bytes]]:
    lines, mat = sheet_lines(sheet), sheet.nested.mat
    yield f"cut/{name}-{sheet.name}.svg", cut_svg(lines, mat, f"{name} {sheet.name}").encode()
    yield f"cut/{name}-{sheet.name}.dxf", cut_dxf(lines, mat).encode()
