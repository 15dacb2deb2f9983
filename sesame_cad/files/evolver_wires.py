"""Wires in a Surface Evolver datafile, each with its own stiffness, also where they touch."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from sesame_cad.files.evolver_commands import BEND, BEND_SHARE, BEND_SOME, STRETCH, STRETCH_SHARE
from sesame_cad.files.evolver_numbers import text
from solver.mesh.bonds import contacts
from solver.mesh.rod_energy import WireStiffness
from solver.mesh.triangulation import Mesh

Vectors = NDArray[np.float64]
Edge = frozenset[int]


@dataclass(frozen=True)
class EvolverWires:
    """What is said of wires at vertices and edges.

    ``sqcurve_string_marked`` bends a vertex between the two edges there whose marks have its bit.
    Wires that share a vertex therefore have bits of their own.

    Attributes
    ----------
    mesh : Mesh
    stiffness : tuple of WireStiffness
        One for each of the mesh's wires, β and k in the datafile's units.
    """

    mesh: Mesh
    stiffness: tuple[WireStiffness, ...]

    @cached_property
    def groups(self) -> tuple[int, ...]:
        """Number from 0 of each wire's bit; no two wires that touch have the same."""
        beside: list[set[int]] = [set() for _ in self.mesh.wires]
        for contact in contacts(self.mesh.wires):
            one, other = contact.wires
            beside[one].add(other)
            beside[other].add(one)
        found: list[int] = []
        for near in beside:
            taken = {found[k] for k in near if k < len(found)}
            found.append(next(k for k in range(len(taken) + 1) if k not in taken))
        return tuple(found)

    @property
    def _one_group(self) -> bool:
        return max(self.groups) == 0

    @cached_property
    def _bend_shares(self) -> tuple[str, ...]:
        """Each wire's β over the first's; nothing to say where all are alike."""
        return _shares([wire.beta for wire in self.stiffness])

    @cached_property
    def _stretch_shares(self) -> tuple[str, ...]:
        return _shares([wire.axial_stiffness for wire in self.stiffness])

    @property
    def declarations(self) -> str:
        """Quantities of bending and stretch."""
        attribute = " element_modulus bend_share_{0}" if self._bend_shares else ""
        numbers = range(max(self.groups) + 1)
        shares = [BEND_SHARE.format(k) for k in numbers] if self._bend_shares else []
        bend = BEND.format(share=attribute.format(0))
        if not self._one_group:
            some = [BEND_SOME.format(k, bit=1 << k, share=attribute.format(k)) for k in numbers]
            methods = " ".join(f"method bend_{k}" for k in numbers)
            bend = "".join(some) + f"quantity bend energy modulus wire_bending {methods}\n"
        share = " element_modulus stretch_share" if self._stretch_shares else ""
        stretched = [STRETCH_SHARE] if self._stretch_shares else []
        return "".join([*shares, *stretched, bend, STRETCH.format(share=share)])

    @cached_property
    def at_vertices(self) -> dict[int, str]:
        """Words for each vertex of a wire; at the ends of open wires nothing bends."""
        words: dict[int, list[str]] = {}
        for number, (wire, group) in enumerate(zip(self.mesh.wires, self.groups, strict=True)):
            own = ["bend" if self._one_group else f"bend_{group}"]
            if self._bend_shares:
                own.append(f"bend_share_{group} {self._bend_shares[number]}")
            for vertex in wire.corners[:, 1].tolist():
                words.setdefault(vertex, []).extend(own)
        return {vertex: " ".join([*said, "on_wire 1"]) for vertex, said in words.items()}

    @cached_property
    def at_edges(self) -> dict[Edge, str]:
        """Words for each edge of a wire."""
        words: dict[Edge, str] = {}
        for number, (wire, group) in enumerate(zip(self.mesh.wires, self.groups, strict=True)):
            ends = wire.edges
            along = self.mesh.points[ends[:, 1]] - self.mesh.points[ends[:, 0]]
            lengths = np.linalg.norm(along, axis=1).tolist()
            share = f" stretch_share {self._stretch_shares[number]}" if self._stretch_shares else ""
            for edge, length in zip(ends.tolist(), lengths, strict=True):
                said = f"stretch hooke_size {text(length)} sqcurve_string_mark {1 << group}"
                words[frozenset(edge)] = said + share
        return words


def _shares(values: list[float]) -> tuple[str, ...]:
    if all(value == values[0] for value in values):
        return ()
    return tuple(text(value / values[0]) for value in values)
