"""Energy of a mesh as the sum of its families of elements."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from solver.mesh.assembly import FamilyAssembly, LowerPattern, block_pattern, family_assembly
from solver.mesh.elements import Curvature, Elements, Stretching

Vectors = NDArray[np.float64]


Family = Elements | tuple[Elements, ...]
"""One term's elements; a tuple where they have different numbers of vertices."""


class Energy(Protocol):
    """Energy of n vertices, units of E_f t R², as a minimisation asks for it."""

    @property
    def pattern(self) -> LowerPattern:
        """Of the Hessian that was given last."""
        ...

    def terms(self, positions: Vectors) -> dict[str, float]:
        """Energy by term at positions (n, 3)."""
        ...

    def value(self, positions: Vectors) -> float:
        """Energy at positions (n, 3); infinite where they must not go."""
        ...

    def derivatives(
        self, positions: Vectors, curvature: Curvature = Curvature.TRUE
    ) -> tuple[float, Vectors, Vectors]:
        """Energy, gradient (n, 3) and the entries (nnz,) of the Hessian's lower triangle."""
        ...

    def excess(self, positions: Vectors, move: Vectors, reached: Vectors) -> Vectors:
        """Pull (3n,) of the stretch that a move (n, 3) brings beyond what is linear in it."""
        ...


@dataclass(frozen=True)
class MeshEnergy:
    """Energy of n vertices, units of E_f t R².

    Attributes
    ----------
    families : mapping
        Elements by the name of their term.
    assemblies : mapping
        Where the derivatives of each of them go.
    pattern : LowerPattern
        Of the Hessian.
    """

    families: Mapping[str, tuple[Elements, ...]]
    assemblies: Mapping[str, tuple[FamilyAssembly, ...]]
    pattern: LowerPattern

    def _placed(self) -> Iterator[tuple[Elements, FamilyAssembly]]:
        for name, family in self.families.items():
            yield from zip(family, self.assemblies[name], strict=True)

    def terms(self, positions: Vectors) -> dict[str, float]:
        """Energy by term at positions (n, 3)."""
        return {
            name: sum(float(e.energies(positions[e.vertices]).sum()) for e in family)
            for name, family in self.families.items()
        }

    def value(self, positions: Vectors) -> float:
        """Energy at positions (n, 3)."""
        return sum(self.terms(positions).values())

    def derivatives(
        self, positions: Vectors, curvature: Curvature = Curvature.TRUE
    ) -> tuple[float, Vectors, Vectors]:
        """Energy, gradient (n, 3) and the entries (nnz,) of the Hessian's lower triangle."""
        value = 0.0
        gradient = np.zeros(self.pattern.size)
        entries = np.zeros(len(self.pattern.rows))
        for elements, assembly in self._placed():
            found = elements.derivatives(positions[elements.vertices], curvature)
            value += float(found[0].sum())
            gradient += assembly.gradient(found[1], self.pattern.size)
            entries += assembly.hessian(found[2], len(self.pattern.rows))
        return value, gradient.reshape(-1, 3), entries

    def excess(self, positions: Vectors, move: Vectors, reached: Vectors) -> Vectors:
        """Pull (3n,) of the stretch that a move (n, 3) brings beyond what is linear in it."""
        pull = np.zeros(self.pattern.size)
        for elements, assembly in self._placed():
            if isinstance(elements, Stretching):
                where = elements.vertices
                found = elements.excess(positions[where], move[where], reached[where])
                pull += assembly.gradient(found, self.pattern.size)
        return pull


def listed(family: Family) -> tuple[Elements, ...]:
    """One term's elements, those of each number of vertices apart."""
    return family if isinstance(family, tuple) else (family,)


def mesh_energy(families: Mapping[str, Family], vertices: int) -> MeshEnergy:
    """Sum of families of elements on so many vertices; empty families are left out."""
    filled = {
        name: tuple(e for e in listed(family) if len(e.vertices))
        for name, family in families.items()
    }
    present = {name: family for name, family in filled.items() if family}
    blocks = block_pattern([e.vertices for f in present.values() for e in f], vertices)
    assemblies = {
        name: tuple(family_assembly(e.vertices, blocks) for e in family)
        for name, family in present.items()
    }
    return MeshEnergy(present, assemblies, blocks.lower())
