"""What a solve returns: the shape, and the account of how it was found."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

from solver.checks import WRITHE_POINTS, smallest_fabric_gap, smallest_wire_gap, writhe
from solver.omitted import OmittedTerm
from solver.scene import LoopScene
from solver.shape import LoopShape


class Kind(StrEnum):
    """Symmetry of a loop's shape.

    ``saddle``: two mirrors, and a quarter turn that changes z into −z. ``aligned``: mirrors in x
    and in y. ``diagonal``: half-turns about x, y and z. ``oblique``: a half-turn about z.
    """

    FLAT = "flat"
    SADDLE = "saddle"
    ALIGNED = "aligned"
    DIAGONAL = "diagonal"
    OBLIQUE = "oblique"


@dataclass(frozen=True)
class Equilibrium:
    """A minimum of a scene's energy; lengths in units of R, energies in units of E_f t R².

    Attributes
    ----------
    scene : LoopScene
    shape : LoopShape
    buckled : bool
        False when the flat loop is itself the minimum.
    status : str
        ``"converged"``, or why the shape must not be relied on.
    energy_terms : dict
        Energy by term.
    gradient_norm : float
        Of the energy by the unknowns.
    lowest_eigenvalue : float
        Of the second variation among all smooth shapes, free motions taken out.
    steps, factorizations : int
        Newton steps tried and Hessians factorised, on all bases together.
    unknowns : int
        Size of the last basis.
    height_change : float
        Relative change of the height from the basis before the last; 0 for a flat loop.
    omitted : tuple of OmittedTerm
    kind : Kind
        The shape's symmetry.
    degree : int
        Of the last basis' polynomials.
    """

    scene: LoopScene
    shape: LoopShape
    buckled: bool
    status: str
    energy_terms: dict[str, float]
    gradient_norm: float
    lowest_eigenvalue: float
    steps: int
    factorizations: int
    unknowns: int
    height_change: float
    omitted: tuple[OmittedTerm, ...]
    kind: Kind
    degree: int

    @property
    def energy(self) -> float:
        """Total energy."""
        return sum(self.energy_terms.values())

    @cached_property
    def writhe(self) -> float:
        """Writhe of the wire, in turns."""
        return writhe(self.shape.edge(WRITHE_POINTS))

    @cached_property
    def wire_gap(self) -> float:
        """Smallest distance of wires across the loop, units of R; negative when crossed."""
        return smallest_wire_gap(self.shape)

    @cached_property
    def fabric_gap(self) -> float:
        """Smallest distance of wire and fabric that lie apart when flat, units of R."""
        return smallest_fabric_gap(self.scene, self.shape)
