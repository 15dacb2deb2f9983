"""The folder that goes to the workshop."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from patterns.records import Records, plan_records
from sesame_cad.design_data import design_data
from sesame_cad.files.dst import decode_dst
from sesame_cad.files.plan_svg import plan_svg
from sesame_cad.package_files import (
    Data,
    Files,
    Progress,
    cut_files,
    stitch_files,
    worksheet_file,
    write_files,
)
from sesame_cad.pictures.plan import plan_picture
from sesame_cad.pictures.shapes import AnyView, ShapeView, SheetView, shapes_picture
from sesame_cad.pipeline import Design, design
from sesame_cad.report.page import REPORT_FILE, report_html
from sesame_cad.shape_files import shape_files
from sesame_cad.shape_state import ShapeState
from sesame_cad.sleeve.design import SleeveDesign, sleeve_design
from sesame_cad.sleeve.package import fill_sleeves, sleeve_pictures
from sesame_cad.specification import Specification
from sesame_cad.specification.layout import SLEEVE
from sesame_cad.staging import staged_directory
from sesame_cad.state import CellState


def write_package(spec: Specification, target: Path, progress: Progress) -> Data:
    """Design an array, or beams with sleeves, and write the folder.

    The folder is made aside and moved into place when it is complete, so that a failure leaves an
    earlier result as it was.

    Returns
    -------
    dict
        What `design.json` holds.

    Raises
    ------
    InputError
        When the specification asks for what cannot be made, or the folder cannot be.
    NotConvergedError
        When there is no shape to rely on.
    """
    with staged_directory(target) as folder:
        if spec.layout.kind == SLEEVE:
            return fill_sleeves(folder, sleeve_design(spec, progress), progress)
        return _fill(folder, design(spec, progress), progress)


def write_design(made: Design | SleeveDesign, target: Path, progress: Progress) -> Data:
    """Write the folder of a design that was made; see `write_package`."""
    with staged_directory(target) as folder:
        if isinstance(made, SleeveDesign):
            return fill_sleeves(folder, made, progress)
        return _fill(folder, made, progress)


def _fill(folder: Path, made: Design, progress: Progress) -> Data:
    records = plan_records(made.pattern.plan, made.spec.patterns_machine())
    data_of = partial(design_data, made, records)
    return write_files(
        folder,
        _files(made, records, progress),
        data_of,
        lambda data: _report(made, data, folder, progress),
    )


def _files(made: Design, records: Records, progress: Progress) -> Files:
    """Every file but `design.json`, by its path in the folder."""
    spec, laid = made.spec, made.pattern
    progress("stitch files")
    yield from stitch_files(made, records)
    progress("cut lines")
    yield from cut_files(made)
    progress("drawing of the plan")
    drawing = plan_svg(laid, spec.diameters_mm, spec.name)
    yield f"plan/{spec.name}.svg", drawing.encode()
    progress("worksheet")
    yield worksheet_file(made, records)
    yield from shape_files(made, progress)
    if spec.output.pictures:
        yield from pictures(made, progress)


def pictures(made: Design | SleeveDesign, progress: Progress = lambda _: None) -> Files:
    """Draw the wire's path, and what is predicted if anything is; by their paths in the folder."""
    if isinstance(made, SleeveDesign):
        yield from sleeve_pictures(made, progress)
        return
    laid = made.pattern
    progress("picture of the wire path")
    yield "pictures/plan.png", plan_picture(laid.circuit, laid.plan, laid.outline, laid.marks)
    if made.states:
        progress("picture of the shapes")
        views = [_view(made.spec, state) for state in made.states]
        yield "pictures/shapes.png", shapes_picture(views)


def _report(made: Design, data: Data, folder: Path, progress: Progress) -> Files:
    """Show the design with the stitches that the written DST file holds."""
    progress("report")
    spec = made.spec
    written = (folder / f"stitch/{spec.name}.dst").read_bytes()
    records = decode_dst(written, spec.dst_switches()).records
    yield REPORT_FILE, report_html(made, data, records).encode()


def _view(spec: Specification, state: ShapeState) -> AnyView:
    height = f"{state.height_mm:.1f} mm high" if state.buckled else "flat"
    pitch = "" if state.pitch_mm is None else f", pitch {state.pitch_mm:.1f} mm"
    title = f"{state.name}: {height}{pitch}"
    if not isinstance(state, CellState):
        return SheetView(title, state.shape)
    return ShapeView(
        title,
        state.surface,
        state.centres_mm(),
        spec.wire.diameter_mm,
    )
