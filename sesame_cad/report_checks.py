"""Whether the page shows the stitches that the machine will make."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from patterns.records import Records
from sesame_cad.errors import DesignFileError
from sesame_cad.report.embedding import read_embedded
from sesame_cad.report.stitch_view import STITCH_DATA, viewed_records


def report_faults(content: bytes, dst: Records) -> Iterator[str]:
    """Compare the records in a page with those of the DST file."""
    try:
        shown = _shown(content)
    except (DesignFileError, UnicodeDecodeError) as error:
        yield str(error)
        return
    same = len(shown.command) == len(dst.command) and (
        np.array_equal(shown.command, dst.command) and np.array_equal(shown.xy, dst.xy)
    )
    if not same:
        yield "its stitches are not those of the DST file"


def _shown(content: bytes) -> Records:
    data: Any = read_embedded(content.decode("utf-8"), STITCH_DATA)
    try:
        return viewed_records(data)
    except (KeyError, TypeError, ValueError, IndexError) as error:
        raise DesignFileError(f"the page's stitches cannot be read: {error!r}") from None
