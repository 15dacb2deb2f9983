"""A map of wanted heights: a CSV file, a line for each row of cells."""

from __future__ import annotations

from pathlib import Path

from sesame_cad.errors import InputError

MOST_CELLS = 400


def read_heights_mm(path: Path) -> list[list[float]]:
    """Read heights in mm; the first line is the first row, the bottom one of the array.

    Raises
    ------
    InputError
        With one line for each fault.
    """
    try:
        lines = path.read_text(encoding="utf-8").split("\n")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: cannot be read as a table: {error}") from None
    rows: list[list[float]] = []
    faults: list[str] = []
    for number, line in enumerate(lines, start=1):
        if not line.strip():
            continue
        row: list[float] = []
        for cell in line.split(","):
            try:
                height = float(cell)
            except ValueError:
                height = -1.0
            if 0 < height < 1e4:
                row.append(height)
            else:
                faults.append(
                    f"{path}, line {number}: {cell.strip()!r}: must be a height in mm, a number "
                    "greater than 0 and less than 10000"
                )
        rows.append(row)
    if not faults and not rows:
        faults.append(f"{path}: holds no heights")
    if not faults and len({len(row) for row in rows}) > 1:
        faults.append(f"{path}: all lines must hold equally many heights")
    if not faults and sum(map(len, rows)) > MOST_CELLS:
        faults.append(f"{path}: {sum(map(len, rows))} cells: at most {MOST_CELLS}")
    if faults:
        raise InputError(*faults)
    return rows
