"""A sweep on disk: what has been solved so far stays, chunk by chunk."""

from __future__ import annotations

import json
import shutil
from collections.abc import Sequence
from pathlib import Path
from typing import Any, cast

from sesame_cad.errors import InputError
from sesame_cad.staging import replace_file
from sesame_cad.sweeps.outcome import Outcome
from sesame_cad.sweeps.plan import SweepPlan
from sesame_cad.sweeps.table import header_csv, read_rows, rows_csv

PLAN_FILE = "sweep.json"
TABLE_FILE = "sweep.csv"
PICTURE_FILE = "sweep.png"
PARQUET_FILE = "sweep.parquet"
CHUNKS = "chunks"

_KNOWN = {PLAN_FILE, TABLE_FILE, PICTURE_FILE, PARQUET_FILE, CHUNKS}


class SweepStore:
    """The folder of one sweep.

    ``sweep.json`` holds the plan from the start; ``chunks`` a piece of the table for each chunk
    that is done; ``sweep.csv`` the whole, once all are.

    Raises
    ------
    InputError
        When the folder holds anything else, or another sweep that is not finished.
    """

    def __init__(self, folder: Path, plan: SweepPlan) -> None:
        self.folder = folder
        self.plan = plan
        self._begun = False
        self._check()

    def _check(self) -> None:
        folder = self.folder
        if not folder.absolute().parent.is_dir():
            raise InputError(f"{folder.parent} is no directory: make it, or choose another place")
        if folder.is_symlink() or (folder.exists() and not folder.is_dir()):
            raise InputError(f"{folder} is no directory: it stays as it is; choose another place")
        held = sorted(path.name for path in folder.iterdir()) if folder.exists() else []
        foreign = [name for name in held if name not in _KNOWN and not name.startswith(".sweep.")]
        if foreign:
            raise InputError(f"{folder} holds {foreign[0]}, which is no sweep's: move it away")
        if held and PLAN_FILE not in held:
            raise InputError(f"{folder} holds {held[0]} but no {PLAN_FILE}: move it away")
        if held and TABLE_FILE not in held and not self._same_plan():
            raise InputError(
                f"{folder} holds another sweep that is not finished: finish it with its own "
                "options, take it away, or choose another place with -o"
            )

    def _begin(self) -> None:
        """Make the folder, once there is something to keep in it."""
        if self.folder.exists() and any(self.folder.iterdir()) and not self._same_plan():
            shutil.rmtree(self.folder)
        (self.folder / CHUNKS).mkdir(parents=True, exist_ok=True)
        if not (self.folder / PLAN_FILE).exists():
            self.write_data({})

    def _same_plan(self) -> bool:
        try:
            data: object = json.loads((self.folder / PLAN_FILE).read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return False
        plan = cast("dict[str, object]", data).get("plan") if isinstance(data, dict) else None
        return plan == json.loads(json.dumps(self.plan.description()))

    def write_data(self, summary: dict[str, Any]) -> dict[str, Any]:
        """Write the plan, and what came out of it."""
        data = {"plan": self.plan.description(), **summary}
        content = json.dumps(data, indent=2, ensure_ascii=False, allow_nan=False) + "\n"
        replace_file(self.folder / PLAN_FILE, content.encode())
        return data

    def _file(self, index: int) -> Path:
        return self.folder / CHUNKS / f"{index:06d}.csv"

    def missing(self) -> list[int]:
        """Chunks that are still to be solved; one that cannot be read whole is."""
        if not self.folder.exists() or not self._same_plan():
            return list(range(self.plan.chunks))
        return [index for index in range(self.plan.chunks) if self._read(index) is None]

    def _read(self, index: int) -> list[Outcome] | None:
        try:
            found = read_rows(self.plan.keys, self._file(index).read_bytes())
        except (OSError, ValueError):
            return None
        return found if len(found) == len(self.plan.chunk(index)) else None

    def save(self, index: int, outcomes: Sequence[Outcome]) -> None:
        """Keep a chunk; half of one is never seen."""
        content = rows_csv(self.plan.keys, self.plan.chunk(index), outcomes)
        if not self._begun:
            self._begin()
            self._begun = True
        replace_file(self._file(index), content)

    def table(self) -> bytes:
        """Give the whole table; all chunks must be there."""
        pieces = [self._file(index).read_bytes() for index in range(self.plan.chunks)]
        return header_csv(self.plan.keys) + b"".join(pieces)

    def outcomes(self) -> list[Outcome]:
        """Give what was found at all points; all chunks must be there."""
        found: list[Outcome] = []
        for index in range(self.plan.chunks):
            found += self._read(index) or []
        return found
