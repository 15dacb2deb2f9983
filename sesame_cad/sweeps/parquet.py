"""A sweep's table as Parquet, for large sweeps and for those who read it with pandas."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import pyarrow as pa  # pyright: ignore[reportMissingImports]
import pyarrow.parquet as pq  # pyright: ignore[reportMissingImports]

from sesame_cad.sweeps.outcome import COLUMNS, Outcome


def table_parquet(
    keys: Sequence[str], points: Sequence[tuple[float, ...]], outcomes: Sequence[Outcome]
) -> bytes:
    """Write the same columns as those of the CSV table, each with its type."""
    columns: dict[str, Any] = {
        key: pa.array([point[k] for point in points], pa.float64())
        for k, key in enumerate(keys)
        if key not in COLUMNS
    }
    rows = [asdict(outcome) for outcome in outcomes]
    flags = dict.fromkeys(("buckled", "slack", "self_meeting"), pa.bool_())
    kinds: dict[str, Any] = {**flags, "status": pa.string()}
    for name in COLUMNS:
        columns[name] = pa.array([row[name] for row in rows], kinds.get(name, pa.float64()))
    stream = io.BytesIO()
    pq.write_table(pa.table(columns), stream)
    return stream.getvalue()
