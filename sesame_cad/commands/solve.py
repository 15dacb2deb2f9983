"""``sesame-cad solve``: one dimensionless loop, or a grid of them."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING

import click

from sesame_cad.errors import InputError
from sesame_cad.number_range import NumberRange

if TYPE_CHECKING:
    from collections.abc import Callable

    from solver.ladder.answer import Answer
    from solver.mesh.scene import ArrayScene
    from solver.scene import LoopScene

_GRID = re.compile(r"([1-9][0-9]{0,2})\s*[x×]\s*([1-9][0-9]{0,2})")


@click.command("solve")
@click.option("--strain", type=float, required=True, help="Prestrain of the fabric, 0 to 2.")
@click.option("--beta", type=float, required=True, help="Bending stiffness of the wire, β > 0.")
@click.option("--poisson", type=float, required=True, help="Poisson's ratio of the fabric.")
@click.option(
    "--reading",
    type=click.Choice(["plane-stress", "published"]),
    default="plane-stress",
    show_default=True,
    help="Reading of the fabric's energy.",
)
@click.option(
    "--axial-stiffness",
    type=float,
    default=1000.0,
    show_default=True,
    help="Stretch stiffness of the wire, E_w A_w / (E_f t R).",
)
@click.option(
    "--axis-ratio",
    type=float,
    default=1.0,
    show_default=True,
    help="Length over width of an elliptical loop; its perimeter is that of the circle.",
)
@click.option(
    "--modulus-ratio",
    type=float,
    default=1.0,
    show_default=True,
    help="E1/E2 of the fabric, along and across; their mean is E_f.",
)
@click.option(
    "--natural-curvature",
    type=float,
    default=0.0,
    show_default=True,
    help="Curvature to which the wire tends by itself, in units of 1/R.",
)
@click.option(
    "--twist-ratio",
    type=float,
    default=0.0,
    show_default=True,
    help="GJ/EI of the wire, about 0.75 if round; 0 adds its twist only where a shape writhes.",
)
@click.option(
    "--alpha",
    type=float,
    default=0.0,
    show_default=True,
    help="Bending stiffness of the fabric, t²/(6R²(1−ν²)), 0 to 1.",
)
@click.option("--loops", default="1x1", show_default=True, help="Rows x columns of an array.")
@click.option(
    "--between",
    type=click.Choice(["cut", "kept"]),
    default="cut",
    show_default=True,
    help="What becomes of the fabric between the loops.",
)
@click.option(
    "--fidelity",
    type=click.Choice(["scaling", "compact", "mesh", "auto"]),
    default="auto",
    show_default=True,
    help="Rung of the ladder; auto takes the cheapest that meets the tolerance.",
)
@click.option(
    "--tolerance",
    type=NumberRange(1e-8, 0.5),
    help="Relative error allowed in the height; 1e-4 unless given, 0.1 of arrays that need a mesh.",
)
@click.option(
    "--contact",
    type=click.Choice(["auto", "off"]),
    default="auto",
    show_default=True,
    help="off: give a mesh that passes through itself as it is, with the number of its crossings.",
)
@click.option("--json", "as_json", is_flag=True, help="Print JSON, and nothing else, to stdout.")
def command(
    strain: float,
    beta: float,
    poisson: float,
    reading: str,
    axial_stiffness: float,
    axis_ratio: float,
    modulus_ratio: float,
    natural_curvature: float,
    twist_ratio: float,
    alpha: float,
    loops: str,
    between: str,
    fidelity: str,
    tolerance: float | None,
    contact: str,
    as_json: bool,
) -> None:
    """Solve one loop, or a grid of loops: energies in units of E_f t R², lengths in units of R.

    R is the radius of a circle of the loop's perimeter. Keys that need a real length or stiffness
    (height_mm, pitch_mm, energy_mJ) are null.
    """
    import json
    from dataclasses import replace
    from time import perf_counter

    from sesame_cad.answer_data import answer_data
    from sesame_cad.progress import telling
    from sesame_cad.scaleless import scaleless_omissions
    from sesame_cad.summary import print_answer
    from solver.errors import NotConvergedError, SceneError
    from solver.reading import Reading
    from solver.scene import LoopScene

    try:
        loop = LoopScene(
            strain,
            beta,
            poisson,
            Reading(reading),
            axial_stiffness,
            axis_ratio,
            modulus_ratio,
            natural_curvature,
            twist_ratio,
            alpha,
        )
        rows, columns = _grid(loops)
        if fidelity == "scaling" and _one_suffices(loop, rows, columns, between):
            solve = _law(loop, tiled=rows * columns > 1)
        else:
            solve = _solver(_scene(loop, rows, columns, between), fidelity, tolerance, contact)
        with telling(quiet=as_json) as progress:
            progress("solving")
            start = perf_counter()
            answer = solve()
            seconds = perf_counter() - start
    except SceneError as error:
        raise InputError(str(error)) from None
    except NotConvergedError as error:
        click.echo(f"error: {error}", err=True)
        raise click.exceptions.Exit(1) from None
    left_out = (*answer.omitted, *scaleless_omissions(alpha, _bending_share(answer)))
    data = answer_data(replace(answer, omitted=left_out), seconds)
    if as_json:
        click.echo(json.dumps(data, indent=2))
    else:
        print_answer(data)


def _bending_share(answer: Answer) -> float:
    """Give what the bending of fabric with α = 1 would have in the energy that one loop releases.

    Not a number where the answer is a law's, or an array's.
    """
    if answer.equilibrium is None:
        return math.nan
    from solver.ladder.fabric_share import curved_fabric
    from solver.scene import LoopScene

    scene = answer.equilibrium.scene
    curved = curved_fabric(answer, scene) if isinstance(scene, LoopScene) else None
    return math.nan if curved is None else curved.bending_share(1.0)


def _grid(loops: str) -> tuple[int, int]:
    """Rows and columns that ``--loops`` names."""
    grid = _GRID.fullmatch(loops.strip())
    if grid is None:
        raise InputError(f"--loops: {loops!r} is not rows x columns, such as 3x3")
    return int(grid[1]), int(grid[2])


def _one_suffices(loop: LoopScene, rows: int, columns: int, between: str) -> bool:
    """Whether one loop tells all: it is alone, or equal ones without fabric between them tile."""
    fabric_between = between == "kept" and min(rows, columns) > 1
    return rows * columns == 1 or (loop.isotropic_circle and not fabric_between)


def _law(loop: LoopScene, *, tiled: bool) -> Callable[[], Answer]:
    """Load no more than the scaling law, which knows one loop and so any number that tile."""
    from functools import partial

    from solver.ladder.law import ASKED, TILED, by_law

    return partial(by_law, loop, f"{TILED}; {ASKED}" if tiled else ASKED)


def _scene(loop: LoopScene, rows: int, columns: int, between: str) -> LoopScene | ArrayScene:
    """Give one loop, or the array."""
    if rows * columns == 1:
        return loop
    from solver.mesh.array_mesh import Between
    from solver.mesh.scene import ArrayScene

    return ArrayScene(loop, rows, columns, Between(between))


def _solver(
    scene: LoopScene | ArrayScene, fidelity: str, tolerance: float | None, contact: str
) -> Callable[[], Answer]:
    """Load what any solve may need."""
    from functools import partial

    from solver.ladder.choose import prepare_tables, solve_scene, usual_tolerance
    from solver.ladder.contact import ContactChoice
    from solver.ladder.fidelity import Fidelity

    prepare_tables()
    return partial(
        solve_scene,
        scene,
        fidelity=Fidelity(fidelity),
        tolerance=usual_tolerance(scene) if tolerance is None else tolerance,
        contact=ContactChoice(contact),
    )
