"""``sesame-cad solve``: one dimensionless loop."""

from __future__ import annotations

import click

from sesame_cad.errors import InputError


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
    "--tolerance",
    type=click.FloatRange(1e-8, 0.1),
    default=1e-4,
    show_default=True,
    help="Relative error allowed in the height.",
)
@click.option("--json", "as_json", is_flag=True, help="Print JSON, and nothing else, to stdout.")
def command(
    strain: float,
    beta: float,
    poisson: float,
    reading: str,
    axial_stiffness: float,
    tolerance: float,
    as_json: bool,
) -> None:
    """Solve one loop of radius 1: energies in units of E_f t R², lengths in units of R.

    Keys that need a real length or stiffness (height_mm, pitch_mm, energy_mJ) are null.
    """
    import json
    from time import perf_counter

    from sesame_cad.design_data import loop_data
    from sesame_cad.summary import print_loop
    from solver.compact import solve_loop
    from solver.errors import NotConvergedError, SceneError
    from solver.reading import Reading
    from solver.scene import LoopScene

    try:
        scene = LoopScene(strain, beta, poisson, Reading(reading), axial_stiffness)
        start = perf_counter()
        found = solve_loop(scene, tolerance=tolerance)
        seconds = perf_counter() - start
    except SceneError as error:
        raise InputError(str(error)) from None
    except NotConvergedError as error:
        click.echo(f"error: {error}", err=True)
        raise click.exceptions.Exit(1) from None
    data = loop_data(found, seconds)
    if as_json:
        click.echo(json.dumps(data, indent=2))
    else:
        print_loop(data)
