"""Whether the page shows the stitches that the machine will make."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from patterns.records import Records
from sesame_cad.errors import DesignFileError
from sesame_cad.report.embedding import read_embedded
from sesame_cad.report.stitch_view import STITCH_DATA, viewed_records


def report_faults(content: bytes, dst: Records, name: str = STITCH_DATA) -> Iterator[str]:
    """Compare the records that a page holds under a name with those of the DST file."""
    try:
        shown = _shown(content, name)
    except (DesignFileError, UnicodeDecodeError) as error:
        yield str(error)
        return
    same = len(shown.command) == len(dst.command) and (
        np.array_equal(shown.command, dst.command) and np.array_equal(shown.xy, dst.xy)
    )
    if not same:
        yield "its stitches are not those of the DST file"


def _shown(content: bytes, name: str) -> Records:
    data: Any = read_embedded(content.decode("utf-8"), name)
    try:
        return viewed_records(data)
    except (KeyError, TypeError, ValueError, IndexError) as error:
        raise DesignFileError(f"the page's stitches cannot be read: {error!r}") from None
