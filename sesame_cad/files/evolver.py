"""Datafiles for Surface Evolver 2.70, the program with which the SESAME paper found its shapes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from sesame_cad.errors import InputError
from sesame_cad.files.evolver_commands import (
    BENDING_FABRIC,
    COMMANDS,
    DECLARATIONS,
    FURTHER,
    FURTHER_ADVICE,
    FURTHER_TERM,
    HEAD,
    HINGE_ADVICE,
    LEVELLING,
    PINS,
    SEVERAL_WIRES,
    TOUCHING,
)
from sesame_cad.files.evolver_fabric import Sides, form_factors, inner_vertices, mesh_sides
from sesame_cad.files.evolver_numbers import text
from sesame_cad.files.evolver_pins import numbered
from sesame_cad.files.evolver_scene import Drawn, EvolverScene, drawn, scene_faults
from sesame_cad.files.evolver_wires import EvolverWires
from solver.errors import SceneError
from solver.mesh.triangulation import Mesh
from solver.reading import Reading
from solver.scene import LoopScene

FEWEST_REFINEMENTS = 1
"""The unrefined fan has no vertex at 45°, where the pins must be."""

MOST_REFINEMENTS = 5
"""20,480 triangles of one loop, over which Evolver takes about half a minute."""

MOST_TRIANGLES = 50_000

START_HEIGHT = 0.05
"""Of the start's crests, over the radius: enough to leave the flat loop, a saddle of the energy."""


def evolver_datafile(
    scene: EvolverScene, refinements: int, start_height: float = START_HEIGHT
) -> str:
    """Write a scene with commands that solve it; energies in units of E_f t R².

    R is the scene's unit of length. The mesh is the solver's own. The fabric is Evolver's
    ``linear_elastic`` on constant-strain triangles, and where it resists bending
    ``star_perp_sq_mean_curvature``; a wire is ``sqcurve_string_marked`` (bending) and
    ``hooke3_energy`` (stretch) along its edges, as stiff as it is by itself.
    Evolver's membrane is that of plane stress; the published reading is the same with
    ν' = ν/(1−ν) and the modulus 2 (1+ν')/(1+ν), in units of E_f.

    Wires that touch share the point, but may turn about it, as Evolver has no bond that keeps their
    tangents parallel. Levelling is as in `solver.mesh.levelling`.

    Parameters
    ----------
    scene : LoopScene or SheetScene
        Loops, circles or ellipses, of isotropic fabric and of wire that is straight by nature.
    refinements : int
        How often the triangles of the coarsest mesh are split in four, 1 to 5.
    start_height : float
        How far the start's crests rise, over a loop's radius; 0 starts flat.

    Returns
    -------
    str
        The file's text, in ASCII.

    Raises
    ------
    InputError
        When the datafile has no words for the scene, it cannot be meshed, or a number is out of its
        range.
    """
    _check(scene, refinements, start_height)
    try:
        found = drawn(scene, refinements, start_height)
    except SceneError as error:
        raise InputError(str(error)) from None
    count = len(found.mesh.triangles)
    if count > MOST_TRIANGLES:
        raise InputError(
            f"{count} triangles: Surface Evolver's datafile is written for {MOST_TRIANGLES} at "
            "most; refine less"
        )
    return "\n".join(_Datafile(found).lines)


def _check(scene: EvolverScene, refinements: int, start_height: float) -> None:
    faults = scene_faults(scene)
    if not FEWEST_REFINEMENTS <= refinements <= MOST_REFINEMENTS:
        limits = f"from {FEWEST_REFINEMENTS} to {MOST_REFINEMENTS}"
        faults.append(f"refinements = {refinements}: must be {limits}")
    if not 0 <= start_height <= 1:
        faults.append(f"start_height = {start_height:g}: must be from 0 to 1")
    if faults:
        raise InputError(*faults)


@dataclass(frozen=True)
class _Datafile:
    """Parts of the file."""

    drawn: Drawn

    @property
    def lines(self) -> list[str]:
        """All of it."""
        return [
            *self._declarations,
            "vertices",
            *self._vertices(),
            "\nedges",
            *self._edges(),
            "\nfaces",
            *self._faces(),
            self._commands,
        ]

    @property
    def _mesh(self) -> Mesh:
        return self.drawn.mesh

    @cached_property
    def _wires(self) -> EvolverWires:
        return EvolverWires(self._mesh, self.drawn.problem.wires)

    @property
    def _declarations(self) -> Iterator[str]:
        loop, wire = self.drawn.loop, self.drawn.problem.wires[0]
        numbers = {
            "strain": text(loop.strain),
            "poisson": text(loop.poisson),
            "beta": text(wire.beta),
            "axial_stiffness": text(wire.axial_stiffness),
        }
        loops = len(self._mesh.wires)
        yield HEAD.format(
            **numbers,
            reading=loop.reading,
            triangles=len(self._mesh.triangles),
            loops="one loop" if loops == 1 else f"{loops} loops",
            size=text(round(self.drawn.size, 6)),
        )
        if self.drawn.touching:
            yield TOUCHING
        yield DECLARATIONS.format(**numbers, modulus=text(_membrane(loop)[1]))
        yield self._wires.declarations
        if len(set(self.drawn.problem.wires)) > 1:
            yield SEVERAL_WIRES
        yield PINS + numbered(self.drawn.pins)[0]
        if self.drawn.problem.levelling > 0:
            yield LEVELLING
        if loop.alpha > 0:
            yield BENDING_FABRIC.format(alpha=text(loop.alpha))

    @property
    def _commands(self) -> str:
        hinged = self.drawn.problem.levelling > 0
        further = {"levelling": "levelling"} if hinged else {}
        if self.drawn.loop.alpha > 0:
            further["fabric_bending"] = "fabric_bend"
        printed = [FURTHER_TERM.format(name=n, quantity=q) for n, q in further.items()]
        advised = COMMANDS.replace(FURTHER_ADVICE, HINGE_ADVICE if hinged else "")
        return advised.replace(FURTHER, "".join(printed))

    def _vertices(self) -> Iterator[str]:
        pins, on_wire = numbered(self.drawn.pins)[1], self._wires.at_vertices
        bends = inner_vertices(self._mesh) if self.drawn.loop.alpha > 0 else set[int]()
        levelled = self.drawn.problem.levelling > 0
        pulls = self.drawn.pulls.tolist()
        for k, place in enumerate(self.drawn.positions.tolist()):
            words = [*map(text, place), pins.get(k, ""), on_wire.get(k, "")]
            words += ["fabric_bend" if k in bends else "", f"pull {pulls[k]}" if levelled else ""]
            yield " ".join(filter(None, [str(1 + k), *words]))

    @cached_property
    def _sides(self) -> Sides:
        return mesh_sides(self._mesh)

    def _edges(self) -> Iterator[str]:
        wire = self._wires.at_edges
        for k, (tail, head) in enumerate(self._sides.edges.tolist()):
            said = wire.get(frozenset((tail, head)), "")
            yield f"{1 + k} {1 + tail} {1 + head} {said}".rstrip()

    def _faces(self) -> Iterator[str]:
        loop = self.drawn.loop
        poisson = f"poisson_ratio {text(_membrane(loop)[0])}"
        factors = form_factors(self._mesh, loop.strain).tolist()
        sides = self._sides.of_triangle.tolist()
        for k, (edges, factor) in enumerate(zip(sides, factors, strict=True)):
            shape = f"form_factors {{{','.join(map(text, factor))}}}"
            yield f"{1 + k} {' '.join(map(str, edges))} tension 0 {poisson} {shape}"


def _membrane(scene: LoopScene) -> tuple[float, float]:
    """Poisson's ratio and modulus with which ``linear_elastic`` has the scene's density."""
    nu = scene.poisson
    if scene.reading is Reading.PLANE_STRESS:
        return nu, 1.0
    effective = nu / (1 - nu)
    return effective, 2 * (1 + effective) / (1 + nu)
