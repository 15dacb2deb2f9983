"""The vertices of a DXF's polylines, which the library writes and reads one by one.

They are most of the file. So the library is given polylines of one vertex each that stands for all,
and the others are put into the text, or taken out of it, in bulk.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Vertices = NDArray[np.float64]

_STAND_IN_Y = -7.25e307
"""No drawing reaches there: it marks the vertex that stands for others, whose number is its x."""

_STAND_IN = re.compile(
    rf"( 90\n)1(\n 70\n\d+\n) 10\n(\d+)\.0\n 20\n{re.escape(repr(_STAND_IN_Y))}\n"
)
_ROWS = re.compile(r"(?: 10\n[^\n]*\n 20\n[^\n]*\n){3,}")


def stand_in(number: int) -> list[tuple[float, float]]:
    """Give the one vertex of a polyline to the library, that stands for all of its vertices."""
    return [(float(number), _STAND_IN_Y)]


def with_vertices(text: str, lines: Sequence[Vertices]) -> str:
    """Put the vertices (n, 2) of each line, by number, where one stands for them."""

    def written(found: re.Match[str]) -> str:
        line = lines[int(found[3])].tolist()
        rows = "".join(f" 10\n{x}\n 20\n{y}\n" for x, y in line)
        return f"{found[1]}{len(line)}{found[2]}{rows}"

    return _STAND_IN.sub(written, text)


def without_vertices(text: str) -> tuple[str, list[Vertices]]:
    """Take out every row of three vertices or more, and leave one that stands for them.

    A text that holds a vertex like that already is left as it is.

    Raises
    ------
    ValueError
        When a coordinate is no number.
    """
    taken: list[Vertices] = []
    if repr(_STAND_IN_Y) in text:
        return text, taken

    def kept(found: re.Match[str]) -> str:
        values = found[0].split("\n")
        taken.append(np.array([*map(float, values[1:-1:2])]).reshape(-1, 2))
        ((x, y),) = stand_in(len(taken) - 1)
        return f" 10\n{x}\n 20\n{y}\n"

    return _ROWS.sub(kept, text), taken


def all_vertices(points: Sequence[tuple[float, float]], taken: Sequence[Vertices]) -> Vertices:
    """Give the vertices (n, 2) of a polyline as read, with those that were taken out of the text.

    Raises
    ------
    IndexError
        When a vertex stands for what was not taken out.
    """
    parts = [
        taken[int(x)] if y == _STAND_IN_Y and x >= 0 else np.array([(x, y)]) for x, y in points
    ]
    return np.concatenate([np.empty((0, 2)), *parts])
