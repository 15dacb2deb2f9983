"""What a solve of a held loop returns."""

from __future__ import annotations

from dataclasses import dataclass

from solver.omitted import OmittedTerm
from solver.plates import Contact, Pitch, Plates
from solver.scene import LoopScene
from solver.shape import LoopShape


@dataclass(frozen=True)
class HeldEquilibrium:
    """A minimum of a held loop's energy among shapes with mirrors in x and in y.

    Lengths in units of R, energies in units of E_f t R², forces in units of E_f t R.

    Attributes
    ----------
    scene : LoopScene
    hold : Plates or Pitch
    shape : LoopShape
    status : str
        ``"converged"``, or why the shape must not be relied on.
    force : float
        With which the loop presses each plate outwards, or each of its bonded crests; negative
        where a bond pulls. It is −dU/dg of the gap or the pitch g.
    force_across : float
        The same of the valleys, −dU/dw, where their distance w is prescribed too; else 0.
    contacts : tuple of Contact
        What touches the plates; empty when the loop stands free between them.
    energy_terms : dict
        Energy by term.
    gradient_norm : float
        Of the energy and the contacts' forces together, by the unknowns.
    lowest_eigenvalue : float
        Of the second variation among all smooth shapes that the contacts allow, free motions and
        turns of the loop as a whole taken out.
    tilt_eigenvalue : float
        The same with the turns that the plates do not stop. Negative where the loop would tilt or
        roll over between frictionless plates unless something keeps it upright.
    overlap : float
        Farthest that a point of the wire is beyond its plate.
    widths : tuple of float
        Extents of the wire along x and along y.
    height : float
        Its extent along z.
    steps, factorizations : int
        Newton steps tried and Hessians factorised, on all bases together.
    unknowns, degree : int
        Size of the last basis, and degree of its polynomials.
    change : float
        Of the force or of the height from the basis before the last, relative, the larger.
    omitted : tuple of OmittedTerm
    """

    scene: LoopScene
    hold: Plates | Pitch
    shape: LoopShape
    status: str
    force: float
    force_across: float
    contacts: tuple[Contact, ...]
    energy_terms: dict[str, float]
    gradient_norm: float
    lowest_eigenvalue: float
    tilt_eigenvalue: float
    overlap: float
    widths: tuple[float, float]
    height: float
    steps: int
    factorizations: int
    unknowns: int
    degree: int
    change: float
    omitted: tuple[OmittedTerm, ...]

    @property
    def energy(self) -> float:
        """Total energy."""
        return sum(self.energy_terms.values())

    @property
    def upright(self) -> bool:
        """Whether the loop stays upright by itself, without friction or neighbours."""
        return self.tilt_eigenvalue >= -1e-6
