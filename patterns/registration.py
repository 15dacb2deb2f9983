"""Registration marks: the same strokes in the stitch file and in the cut file."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Mark:
    """A mark drawn in strokes.

    Attributes
    ----------
    x_mm, y_mm : float
        Its centre.
    strokes : tuple of arrays (n, 2)
        Open polylines in mm. A cross has two; the asymmetric mark (an F) shows a mirrored sheet.
    """

    x_mm: float
    y_mm: float
    strokes: tuple[NDArray[np.float64], ...]
