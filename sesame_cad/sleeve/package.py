"""The files of beams with sleeves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path
from types import MappingProxyType

from sesame_cad.files.cut_dxf import cut_dxf
from sesame_cad.files.cut_line import CutLine, cut_line
from sesame_cad.files.cut_svg import cut_svg
from sesame_cad.files.dst import decode_dst
from sesame_cad.files.stl import write_stl
from sesame_cad.package_files import (
    Data,
    Files,
    Progress,
    cut_files,
    stitch_files,
    worksheet_file,
    write_files,
)
from sesame_cad.pictures.landscape import landscape_picture
from sesame_cad.pictures.plan import plan_picture
from sesame_cad.pictures.segment import segment_picture
from sesame_cad.pictures.sleeve_force import sleeve_force_picture
from sesame_cad.report.page import REPORT_FILE
from sesame_cad.report.sleeve_page import sleeve_report_html
from sesame_cad.sleeve.cutting import Sheet
from sesame_cad.sleeve.data import sleeve_design_data
from sesame_cad.sleeve.design import SleeveDesign
from sesame_cad.sleeve.plan import sleeve_plan_svg
from sesame_cad.sleeve_prediction.curves import force_curve_csv
from sesame_cad.sleeve_prediction.solids import segment_solids

FORCE_FILE = "shape/sleeve-force.csv"
PREDICTED_PICTURES: Mapping[str, str] = MappingProxyType(
    {
        "segment": "A beam with its sleeves and its constraint in both states.",
        "landscape": "Energy on the way from one state to the other.",
        "sleeve-force": "Force of a sleeve against the distance of its loops, cold and hot.",
    }
)
"""What each picture of the prediction shows, by its name."""


def fill_sleeves(folder: Path, made: SleeveDesign, progress: Progress) -> Data:
    """Write everything into a folder, and give what `design.json` holds."""
    shown = tuple(_states(made, progress))
    return write_files(
        folder,
        _files(made, shown, progress),
        partial(sleeve_design_data, made),
        lambda data: _report(made, data, shown, folder, progress),
    )


def sleeve_pictures(made: SleeveDesign, progress: Progress = lambda _: None) -> Files:
    """Draw both arrays, and what the sleeves do if it is predicted; by their paths."""
    yield from _plans(made)
    yield from _states(made, progress)


def _plans(made: SleeveDesign) -> Files:
    for layer, hooping in made.hoopings.items():
        laid = hooping.pattern
        picture = plan_picture(laid.circuit, laid.plan, laid.outline, laid.marks)
        yield f"pictures/plan-{layer}.png", picture


def _states(made: SleeveDesign, progress: Progress) -> Files:
    if made.prediction is None:
        return
    progress("pictures of the states")
    drawn = {
        "segment": partial(segment_picture, made.spec, made.prediction),
        "landscape": partial(landscape_picture, made.prediction),
        "sleeve-force": partial(sleeve_force_picture, made.prediction, made.force_curves),
    }
    for name in PREDICTED_PICTURES:
        yield f"pictures/{name}.png", drawn[name]()


def _report(
    made: SleeveDesign,
    data: Data,
    shown: tuple[tuple[str, bytes], ...],
    folder: Path,
    progress: Progress,
) -> Files:
    """Show the design with the stitches that the written DST files hold."""
    progress("report")
    switches = made.spec.dst_switches()
    records = {
        layer: decode_dst((folder / f"stitch/{one.spec.name}.dst").read_bytes(), switches).records
        for layer, one in made.hoopings.items()
    }
    words = ((PREDICTED_PICTURES[Path(path).stem], content) for path, content in shown)
    yield REPORT_FILE, sleeve_report_html(made, data, records, words).encode()


def _files(made: SleeveDesign, shown: tuple[tuple[str, bytes], ...], progress: Progress) -> Files:
    """Every file but `design.json` and the report, by its path in the folder."""
    name = made.spec.name
    for layer, hooping in made.hoopings.items():
        records = made.records[layer]
        progress(f"stitch files of the {layer} array")
        yield from stitch_files(hooping, records)
        yield from cut_files(hooping)
        yield worksheet_file(hooping, records)
    if made.spec.output.pictures:
        yield from _plans(made)
        yield from shown
    progress("sheets to cut")
    for sheet in made.pattern.cutting.sheets:
        yield from _sheet_files(name, sheet)
    progress("drawing of the plan")
    yield f"plan/{name}.svg", sleeve_plan_svg(made).encode()
    if made.prediction is not None:
        for part, solid in segment_solids(made.spec, made.prediction, progress):
            yield f"shape/{part}.stl", write_stl(solid, f"{name} {part}")
        yield FORCE_FILE, force_curve_csv(made.force_curves).encode()


def sheet_lines(sheet: Sheet) -> tuple[CutLine, ...]:
    """Give the lines of a sheet in the order of cutting."""
    return tuple(map(cut_line, sheet.cuts))


def _sheet_files(name: str, sheet: Sheet) -> Iterator[tuple[str, bytes]]:
    lines, mat = sheet_lines(sheet), sheet.nested.mat
    yield f"cut/{name}-{sheet.name}.svg", cut_svg(lines, mat, f"{name} {sheet.name}").encode()
    yield f"cut/{name}-{sheet.name}.dxf", cut_dxf(lines, mat).encode()
