"""The square grid of equal loops, and the order in which a serpentine visits it."""

from __future__ import annotations

from patterns.layout import Layout, tangent_layout
from patterns.loop import Loop


def square_grid(rows: int, columns: int, loop_diameter_mm: float) -> Layout:
    """Lay rows × columns tangent loops, centred on the origin.

    Loop ``row * columns + column`` has its row counted from the bottom, its column from the left.
    """
    pitch = loop_diameter_mm
    return tangent_layout(
        tuple(
            Loop((c - (columns - 1) / 2) * pitch, (r - (rows - 1) / 2) * pitch, loop_diameter_mm)
            for r in range(rows)
            for c in range(columns)
        )
    )


def serpentine(rows: int, columns: int) -> tuple[int, ...]:
    """Give the loops of a square grid in the order of a path that turns at the end of each row."""
    return tuple(
        r * columns + (c if r % 2 == 0 else columns - 1 - c)
        for r in range(rows)
        for c in range(columns)
    )
