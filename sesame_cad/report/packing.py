"""Arrays of numbers inside a page: few bytes, read by a browser without parsing digits."""

from __future__ import annotations

import base64
from typing import Any

import numpy as np
from numpy.typing import NDArray

Packed = dict[str, Any]

STEPS = 32767
"""Largest 16-bit number: of a metre it leaves 0.03 mm."""


def packed_reals(values: NDArray[np.float64]) -> Packed:
    """Pack reals as 16-bit numbers times a scale, which rounds to a 65534th of the largest."""
    largest = float(np.abs(values).max(initial=0.0))
    scale = largest / STEPS or 1.0
    return packed_integers(np.rint(values / scale).astype("<i2")) | {"scale": scale}


def packed_integers(values: NDArray[np.integer[Any]]) -> Packed:
    """Pack whole numbers of the type that they have, such as int8 or uint32."""
    plain = np.ascontiguousarray(values, dtype=values.dtype.newbyteorder("<"))
    return {
        "type": values.dtype.name,
        "shape": list(values.shape),
        "data": base64.b64encode(plain.tobytes()).decode("ascii"),
    }


def unpacked(packed: Packed) -> NDArray[Any]:
    """Read packed numbers back: reals where there is a scale."""
    kind = np.dtype(packed["type"]).newbyteorder("<")
    values = np.frombuffer(base64.b64decode(packed["data"]), dtype=kind).reshape(packed["shape"])
    return values * packed["scale"] if "scale" in packed else values
