"""The folder that goes to the workshop."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from patterns.records import Records, plan_records
from sesame_cad.design_data import design_data
from sesame_cad.files.block_list import block_list_csv
from sesame_cad.files.dst import write_dst
from sesame_cad.files.dxf import outline_dxf
from sesame_cad.files.plan_svg import plan_svg
from sesame_cad.files.stitch_formats import write_embroidery
from sesame_cad.files.stl import write_stl
from sesame_cad.files.svg import outline_svg
from sesame_cad.pictures.plan import plan_picture
from sesame_cad.pictures.shapes import AnyView, ShapeView, SheetView, shapes_picture
from sesame_cad.pictures.worksheet import worksheet_pdf
from sesame_cad.pipeline import Design, design
from sesame_cad.preview import solids
from sesame_cad.shape_state import ShapeState
from sesame_cad.specification import Specification
from sesame_cad.staging import DESIGN_FILE, staged_directory
from sesame_cad.state import CellState
from sesame_cad.threads import threads_of
from sesame_cad.worksheet import worksheet

Progress = Callable[[str], None]


def write_package(spec: Specification, target: Path, progress: Progress) -> dict[str, Any]:
    """Design an array and write its folder.

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
        made = design(spec, progress)
        records = plan_records(made.pattern.plan, spec.patterns_machine())
        files: dict[str, dict[str, Any]] = {}
        for path, content in _files(made, records, progress):
            _write(folder / path, content)
            files[path] = file_data(content)
        data = design_data(made, records, dict(sorted(files.items())))
        text = json.dumps(data, indent=2, ensure_ascii=False, allow_nan=False)
        _write(folder / DESIGN_FILE, f"{text}\n".encode())
    return data


def file_data(content: bytes) -> dict[str, Any]:
    """Size and hash by which a file is known again."""
    return {"bytes": len(content), "sha256": hashlib.sha256(content).hexdigest()}


def _files(made: Design, records: Records, progress: Progress) -> Iterator[tuple[str, bytes]]:
    """Every file but `design.json`, by its path in the folder."""
    spec, laid = made.spec, made.pattern
    progress("stitch files")
    threads = threads_of(laid.plan, spec.machine)
    for name in spec.output.formats:
        if name == "dst":
            yield f"stitch/{spec.name}.dst", write_dst(records, spec.name, spec.dst_switches())
        else:
            yield f"stitch/{spec.name}.{name}", write_embroidery(records, name, threads)
    yield f"stitch/{spec.name}.blocks.csv", block_list_csv(laid.plan, threads).encode()
    progress("cut lines")
    yield f"cut/{spec.name}.svg", outline_svg(laid.outline, laid.marks, spec.name).encode()
    yield f"cut/{spec.name}.dxf", outline_dxf(laid.outline, laid.marks).encode()
    progress("drawing of the plan")
    drawing = plan_svg(laid, spec.diameters_mm, spec.name)
    yield f"plan/{spec.name}.svg", drawing.encode()
    progress("worksheet")
    sheet = worksheet(made, records)
    yield f"worksheet/{spec.name}.pdf", worksheet_pdf(sheet, laid, spec.output.paper)
    for name, solid in solids(made, progress):
        yield f"shape/{name}.stl", write_stl(solid, f"{spec.name} {name}")
    if spec.output.pictures:
        progress("picture of the wire path")
        yield (
            "pictures/plan.png",
            plan_picture(laid.circuit, laid.plan, laid.outline, laid.marks),
        )
        if made.states:
            progress("picture of the shapes")
            views = [_view(made.spec, state) for state in made.states]
            yield "pictures/shapes.png", shapes_picture(views)


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


def _write(path: Path, content: bytes) -> None:
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(content)
