"""``sesame-cad export-evolver``: a loop as a datafile of Surface Evolver."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from sesame_cad.errors import InputError

if TYPE_CHECKING:
    from solver.scene import LoopScene


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
    "--refinements",
    type=int,
    default=2,
    show_default=True,
    help="How often each of 20 triangles is split in four, 1 to 5.",
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
    """Write a loop of SPEC, a TOML file, or of the options alone for Surface Evolver 2.70.

    In Surface Evolver, `solve` finds the shape, and `report` prints its height and its energies in
    units of E_f t R². A file that exists is left as it is.
    """
    given = {key: value for key, value in loop.items() if value is not None}
    if spec is None:
        _refuse_state(state)
        name, scene = "loop", _scene_of_options(given)
    else:
        _refuse_options(given)
        name, scene = _scene_of_file(spec, state or "cold")
    target = output or Path(f"{name}.fe")
    _write(target, scene, refinements)
    if not quiet:
        click.echo(f"wrote {target}; next: evolver {target}, and type solve at its prompt")


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


def _scene_of_file(spec: Path, state: str) -> tuple[str, LoopScene]:
    """Give the loop of a specification, and a name for its file."""
    from sesame_cad.specification import load_specification
    from sesame_cad.state import loop_materials, loop_scene
    from solver.errors import SceneError

    read = load_specification(spec)
    modulus = read.wire.modulus_cold_GPa if state == "cold" else read.wire.modulus_hot_GPa
    try:
        return f"{read.name}-{state}", loop_scene(read, loop_materials(read, modulus))
    except SceneError as error:
        raise InputError(f"{read.name}: {error}") from None


def _write(target: Path, scene: LoopScene, refinements: int) -> None:
    from sesame_cad.files.evolver import evolver_datafile
    from sesame_cad.staging import write_new_file

    write_new_file(target, evolver_datafile(scene, refinements).encode("ascii"))


def _option(key: str) -> str:
    return f"--{key.replace('_', '-')}"
