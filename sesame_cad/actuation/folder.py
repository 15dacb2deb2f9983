"""A folder of results that is written aside, with a list of its files."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from sesame_cad.package_files import file_data
from sesame_cad.staging import staged_directory


def write_folder(
    target: Path, listing: str, data: Mapping[str, Any], files: Mapping[str, bytes]
) -> dict[str, Any]:
    """Write files, and numbers with a list of these files; all of it or nothing.

    Parameters
    ----------
    listing : str
        Name of the file with the numbers, which marks a result of this kind.
    files : mapping
        Content by path in the folder.

    Returns
    -------
    dict
        What the listing holds.

    Raises
    ------
    InputError
        When the target must not be replaced or its parent cannot be written to.
    """
    listed = {path: file_data(content) for path, content in sorted(files.items())}
    whole = {**data, "files": listed}
    text = json.dumps(whole, indent=2, ensure_ascii=False, allow_nan=False)
    with staged_directory(target, listing) as folder:
        for path, content in files.items():
            (folder / path).parent.mkdir(exist_ok=True)
            (folder / path).write_bytes(content)
        (folder / listing).write_text(f"{text}\n", encoding="utf-8")
    return whole
