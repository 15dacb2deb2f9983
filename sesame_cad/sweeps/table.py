"""A sweep's table: the swept keys, and what was found at each point."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence

from sesame_cad.sweeps.outcome import COLUMNS, Outcome, cells, outcome_of

Point = tuple[float, ...]


def header(keys: Sequence[str]) -> list[str]:
    """Columns: swept keys that no outcome has under the same name, and the outcome's own."""
    return [key for key in keys if key not in COLUMNS] + list(COLUMNS)


def rows_csv(keys: Sequence[str], points: Sequence[Point], outcomes: Sequence[Outcome]) -> bytes:
    """Write rows, without a header."""
    kept = [k for k, key in enumerate(keys) if key not in COLUMNS]
    return _csv(
        [*(repr(point[k]) for k in kept), *cells(outcome)]
        for point, outcome in zip(points, outcomes, strict=True)
    )


def header_csv(keys: Sequence[str]) -> bytes:
    """Write the header."""
    return _csv([header(keys)])


def read_rows(keys: Sequence[str], content: bytes) -> list[Outcome]:
    """Read rows back.

    Raises
    ------
    ValueError
        When they are not whole.
    """
    skipped = len(header(keys)) - len(COLUMNS)
    if not content.endswith(b"\n"):
        raise ValueError("the last line has no end")
    return [outcome_of(row[skipped:]) for row in csv.reader(io.StringIO(content.decode()))]


def _csv(rows: Iterable[Sequence[str]]) -> bytes:
    stream = io.StringIO()
    csv.writer(stream, lineterminator="\n").writerows(rows)
    return stream.getvalue().encode()
