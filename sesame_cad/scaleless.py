"""What a dimensionless solve leaves out because it is told no thickness and no weight."""

from __future__ import annotations

import math

from solver.omitted import SMALL, OmittedTerm

_GRAVITY = (
    "weight of a loop / (E_f t R), which is not known here and in a design is; "
    f"it matters above {SMALL:g}"
)
_BENDING = (
    "its energy / energy released by buckling, for each unit of alpha = t²/(6R²(1−ν²)), "
    "which was not given"
)


def scaleless_omissions(alpha: float, bending_share: float) -> tuple[OmittedTerm, ...]:
    """Give gravity, and the fabric's bending where α is 0, with the number that would decide.

    Parameters
    ----------
    bending_share : float
        Bending energy of the shape at α = 1 over what buckling released, by α times which the
        height errs, about; not a number where no shape of one loop tells it.
    """
    gravity = OmittedTerm("gravity", _GRAVITY, math.nan, matters=False)
    if alpha > 0:  # then the ladder has decided
        return (gravity,)
    bending = OmittedTerm("bending of the fabric", _BENDING, bending_share, matters=False)
    return (bending, gravity)
