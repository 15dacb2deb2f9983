"""The folder ``shape`` of a package: the array flat, cold and hot, to print and to look at."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from sesame_cad.bodies import Body
from sesame_cad.files.glb import write_glb
from sesame_cad.files.stl import write_stl
from sesame_cad.files.threemf import write_3mf
from sesame_cad.files.vtu import write_vtu
from sesame_cad.pipeline import Design
from sesame_cad.preview import joined, previews
from sesame_cad.solved_mesh import solved_mesh


def shape_files(made: Design, progress: Callable[[str], None]) -> Iterator[tuple[str, bytes]]:
    """Give each file by its path in the folder; none of a design without a shape."""
    for name, bodies in previews(made, progress):
        label = f"{made.spec.name} {name}"
        for kind in made.spec.output.shapes:
            if kind != "vtu":
                yield f"shape/{name}.{kind}", _drawn(kind, bodies, label)
    if "vtu" in made.spec.output.shapes:
        for state in made.states:
            yield f"shape/{state.name}.vtu", write_vtu(solved_mesh(made.spec, state))


def shape_paths(made: Design) -> Iterator[str]:
    """Paths of these files."""
    names = [state.name for state in made.states]
    for kind in made.spec.output.shapes:
        drawn = names if kind == "vtu" or not names else ["flat", *names]
        yield from (f"shape/{name}.{kind}" for name in drawn)


def _drawn(kind: str, bodies: tuple[Body, ...], label: str) -> bytes:
    if kind == "glb":
        return write_glb(bodies)
    if kind == "3mf":
        return write_3mf(bodies, label)
    return write_stl(joined(bodies), label)
