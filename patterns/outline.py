"""The lines along which the fabric is cut at release."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Ring = NDArray[np.float64]
"""A closed line, shape (n, 2) in mm; the first point is not repeated at the end."""


@dataclass(frozen=True)
class Outline:
    """Cut lines on the stretched fabric.

    Attributes
    ----------
    outside : Ring
        Counter-clockwise.
    openings : tuple of Ring
        Clockwise: the fabric between the loops that goes away.
    """

    outside: Ring
    openings: tuple[Ring, ...]
