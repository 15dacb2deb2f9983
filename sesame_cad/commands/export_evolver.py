"""``sesame-cad export-evolver``: loops as a datafile of Surface Evolver."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from sesame_cad.errors import InputError

if TYPE_CHECKING:
    from sesame_cad.files.evolver_scene import EvolverScene
    from sesame_cad.specification import Specification
    from solver.scene import LoopScene

HINGED = (
    "wires that touch share the point but may turn about it: Surface Evolver has no bond that "
    "keeps them side by side"
)


@click.command("export-evolver")
@click.argument("spec", required=False, type=click.Path(path_type=Path))
@click.option(
    "--state", type=click.Choice(["cold", "hot"]), help="The wire's, with SPEC. [default: cold]"
)
@click.option("--strain", type=float, help="Prestrain of the fabric, 0 to 2.")
@click.option("--beta", type=float, help="Bending stiffness of the wire, β > 0.")
@click.option("--poisson", type=float, help="Poisson's ratio of the fabric.")
@click.option(
    "--reading",
    type=click.Choice(["plane-stress", "published"]),
    help="Reading of the fabric's energy. [default: plane-stress]",
)
@click.option(
    "--axial-stiffness",
    type=float,
    help="Stretch stiffness of the wire, E_w A_w / (E_f t R). [default: 1000]",
)
@click.option(
    "--alpha", type=float, help="Bending stiffness of the fabric, t²/(6R²(1−ν²)). [default: 0]"
)
@click.option(
    "--axis-ratio",
    type=float,
    help="Length of an ellipse over its width, its perimeter kept, 1 to 10. [default: 1]",
)
@click.option(
    "--refinements",
    type=int,
    default=2,
    show_default=True,
    help="How often each triangle of the coarsest mesh (20 in a circle) is split in four, 1 to 5.",
)
@click.option(
    "--output",
    "-o",
    type=click.Path(path_type=Path),
    help="File to write. [default: NAME-STATE.fe, or loop.fe without SPEC]",
)
@click.option("--quiet", "-q", is_flag=True, help="Print nothing.")
def command(
    spec: Path | None,
    state: str | None,
    refinements: int,
    output: Path | None,
    quiet: bool,
    **loop: float | str | None,
) -> None:
    """Write SPEC, a TOML file, or the loop of the options alone for Surface Evolver 2.70.

    All loops of SPEC are written, or one if it stands for all: circles in a grid or row whose
    fabric in between is cut away take the same shape side by side. layout.shape = "coupled" writes
    all of those, too. Circles and ellipses, fabric cut or kept, and circuits of different wires can
    be written, sleeves can not. Wires that touch share a point and may turn about it, as Surface
    Evolver has no bond that keeps them side by side.

    In Surface Evolver, `solve` finds the shape, and `report` prints its height and its energies in
    units of E_f t R², R being the radius of the largest loop (of an ellipse, that of the circle of
    its perimeter). A file that exists is left as it is.
    """
    given = {key: value for key, value in loop.items() if value is not None}
    if spec is None:
        _refuse_state(state)
        name, scene, notes = "loop", _scene_of_options(given), ()
    else:
        _refuse_options(given)
        name, scene, notes = _scene_of_file(spec, state or "cold")
    target = output or Path(f"{name}.fe")
    _write(target, scene, refinements)
    if not quiet:
        click.echo(f"wrote {target}; next: evolver {target}, and type solve at its prompt")
        for note in notes:
            click.echo(note)


def _refuse_state(state: str | None) -> None:
    if state is not None:
        raise InputError("--state: needs SPEC, whose wire is cold or hot; without, --beta says it")


def _refuse_options(given: dict[str, float | str]) -> None:
    if given:
        raise InputError(
            *(f"{_option(key)}: SPEC says it already; give one of both" for key in given)
        )


def _scene_of_options(given: dict[str, float | str]) -> LoopScene:
    from solver.errors import SceneError
    from solver.reading import Reading
    from solver.scene import LoopScene

    missing = [key for key in ("strain", "beta", "poisson") if key not in given]
    if missing:
        raise InputError(*(f"{_option(key)}: missing; give it, or SPEC" for key in missing))
    reading = Reading(given.pop("reading", Reading.PLANE_STRESS))
    try:
        return LoopScene(reading=reading, **{key: float(value) for key, value in given.items()})
    except SceneError as error:
        raise InputError(str(error)) from None


def _scene_of_file(spec: Path, state: str) -> tuple[str, EvolverScene, tuple[str, ...]]:
    """Give the scene of a specification, a name for its file, and what to know of it."""
    from sesame_cad.evolver_scene import specified_scene
    from sesame_cad.specification import load_specification

    read = load_specification(spec)
    scene = specified_scene(read, state)
    return f"{read.name}-{state}", scene, _notes(read, scene)


def _notes(spec: Specification, scene: EvolverScene) -> tuple[str, ...]:
    from solver.scene import LoopScene

    unit_mm = spec.layout.diameter_mm / 2
    if isinstance(scene, LoopScene):
        count = spec.layout.count
        alone = (
            f"one loop stands for all {count}, whose shapes fit side by side; "
            'layout.shape = "coupled" writes all'
        )
        return (f"R = {unit_mm:g} mm", *([alone] if count > 1 else []))
    return (f"R = {unit_mm:g} mm, loops: {len(scene.wires)}", *([HINGED] if scene.joints else []))


def _write(target: Path, scene: EvolverScene, refinements: int) -> None:
    from sesame_cad.files.evolver import evolver_datafile
    from sesame_cad.staging import write_new_file

    write_new_file(target, evolver_datafile(scene, refinements).encode("ascii"))


def _option(key: str) -> str:
    return f"--{key.replace('_', '-')}"
