"""Where two accounts of a design, as plain data, differ."""

from __future__ import annotations

import math
from collections.abc import Iterator

RELATIVE_TOLERANCE = 1e-6
"""Numbers are made again on another machine at most this far off."""

ACCOUNT = frozenset({"seconds", "steps", "factorizations", "gradient_norm", "height_change"})
"""Keys that tell how a number was found; they may differ where the number does not."""


def differences(said: object, expected: object, where: str) -> Iterator[str]:
    """Give a line for each place at which what is said is not what is expected."""
    if isinstance(expected, dict) and isinstance(said, dict):
        for key in sorted(expected.keys() | said.keys(), key=str):
            if key in ACCOUNT:
                continue
            if key not in said or key not in expected:
                yield f"{where}: {key} {'is missing' if key not in said else 'does not belong'}"
            else:
                yield from differences(said[key], expected[key], f"{where}: {key}")
    elif isinstance(expected, list) and isinstance(said, list) and len(said) == len(expected):
        for k, (one, other) in enumerate(zip(said, expected, strict=True)):
            yield from differences(one, other, f"{where}[{k}]")
    elif not _same(said, expected):
        yield f"{where} = {said!r}: should be {expected!r}"


def _same(said: object, expected: object) -> bool:
    if isinstance(expected, float) and isinstance(said, int | float):
        return math.isclose(said, expected, rel_tol=RELATIVE_TOLERANCE, abs_tol=1e-7)
    return said == expected
