"""What the folders of all kinds of designs hold in common, and how they are written."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

from patterns.records import Records
from sesame_cad.files.block_list import block_list_csv
from sesame_cad.files.dst import write_dst
from sesame_cad.files.dxf import outline_dxf
from sesame_cad.files.stitch_formats import write_embroidery
from sesame_cad.files.svg import outline_svg
from sesame_cad.pictures.worksheet import worksheet_pdf
from sesame_cad.pipeline import Design
from sesame_cad.staging import DESIGN_FILE
from sesame_cad.threads import threads_of
from sesame_cad.worksheet import worksheet

Progress = Callable[[str], None]
Data = dict[str, Any]
Files = Iterator[tuple[str, bytes]]


def write_files(
    folder: Path,
    contents: Iterable[tuple[str, bytes]],
    data_of: Callable[[dict[str, Data]], Data],
    pages_of: Callable[[Data], Iterable[tuple[str, bytes]]] = lambda _: (),
) -> Data:
    """Write files and, last, `design.json`.

    Parameters
    ----------
    contents
        Path in the folder and content of each file.
    data_of
        Gives what `design.json` holds from size and hash of the files.
    pages_of
        Gives files that show what `design.json` holds, once the others are written.

    Returns
    -------
    dict
        What `design.json` holds.
    """
    files = _written(folder, contents)
    data = data_of(files)
    data["files"] = dict(sorted({**files, **_written(folder, pages_of(data))}.items()))
    text = json.dumps(data, indent=2, ensure_ascii=False, allow_nan=False)
    (folder / DESIGN_FILE).write_bytes(f"{text}\n".encode())
    return data


def _written(folder: Path, contents: Iterable[tuple[str, bytes]]) -> dict[str, Data]:
    """Write files, and tell size and hash of each by its path."""
    files: dict[str, Data] = {}
    for path, content in contents:
        (folder / path).parent.mkdir(exist_ok=True)
        (folder / path).write_bytes(content)
        files[path] = file_data(content)
    return dict(sorted(files.items()))


def file_data(content: bytes) -> Data:
    """Size and hash by which a file is known again."""
    return {"bytes": len(content), "sha256": hashlib.sha256(content).hexdigest()}


def stitch_files(made: Design, records: Records) -> Files:
    """Give the stitch files of one hooping, and the list of its blocks."""
    spec, plan = made.spec, made.pattern.plan
    threads = threads_of(plan, spec.machine)
    for name in spec.output.formats:
        if name == "dst":
            yield f"stitch/{spec.name}.dst", write_dst(records, spec.name, spec.dst_switches())
        else:
            yield f"stitch/{spec.name}.{name}", write_embroidery(records, name, threads)
    yield f"stitch/{spec.name}.blocks.csv", block_list_csv(plan, threads).encode()


def cut_files(made: Design) -> Files:
    """Give the cut lines of one piece of fabric."""
    name, laid = made.spec.name, made.pattern
    yield f"cut/{name}.svg", outline_svg(laid.outline, laid.marks, name).encode()
    yield f"cut/{name}.dxf", outline_dxf(laid.outline, laid.marks).encode()


def worksheet_file(made: Design, records: Records) -> tuple[str, bytes]:
    """Give the worksheet of one hooping."""
    sheet = worksheet(made, records)
    paper = made.spec.output.paper
    return f"worksheet/{made.spec.name}.pdf", worksheet_pdf(sheet, made.pattern, paper)
