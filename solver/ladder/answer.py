"""What every rung of the ladder answers, in the same words."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING

from solver.omitted import OmittedTerm

if TYPE_CHECKING:  # the law must not load what the other rungs need
    from solver.equilibrium import Equilibrium
    from solver.mesh.equilibrium import MeshEquilibrium


class Rung(StrEnum):
    """A way to solve: the further down, the more it can do and the longer it takes."""

    SCALING = "scaling"
    COMPACT = "compact"
    MESH = "mesh"


@dataclass(frozen=True)
class Answer:
    """A solved scene, whichever rung solved it; lengths in units of R, energies of E_f t R².

    Attributes
    ----------
    rung : Rung
    reason : str
        Why this rung.
    buckled : bool
    height_over_perimeter : float
        Height over the length of one loop's wire; of an array, that of the whole.
    height_error : float
        Estimated error of the height, relative to it; absolute where the height is 0.
    terms : tuple of str
        What is in the energy.
    omitted : tuple of OmittedTerm
        What is not, with the number that says how much it matters.
    equilibrium : Equilibrium, MeshEquilibrium or None
        The solved shape; none where only a law was asked.
    """

    rung: Rung
    reason: str
    buckled: bool
    height_over_perimeter: float
    height_error: float
    terms: tuple[str, ...]
    omitted: tuple[OmittedTerm, ...]
    equilibrium: Equilibrium | MeshEquilibrium | None
