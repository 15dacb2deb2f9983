"""``sesame-cad force``: what one loop pushes with, between two rigid plates."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from sesame_cad.errors import InputError

if TYPE_CHECKING:
    from sesame_cad.actuation.force import Vice

LISTING = "force.json"


@click.command("force")
@click.argument("spec", type=click.Path(path_type=Path))
@click.option("--gap", "gaps", multiple=True, help="Distance of the plates, such as 20mm.")
@click.option("--gaps", "gap_range", help="Many of them, such as 15..45mm.")
@click.option(
    "--points",
    type=click.IntRange(2, 200),
    default=13,
    show_default=True,
    help="Points of a range.",
)
@click.option(
    "--axis",
    type=click.Choice(["lateral", "across", "height"]),
    default="lateral",
    show_default=True,
    help="The plates stand at the loop's crests, at its valleys, or above and below.",
)
@click.option("--poisson", type=float, help="Poisson's ratio of the fabric, instead of SPEC's.")
@click.option(
    "--measured-to",
    type=click.Choice(["centreline", "surface"]),
    default="centreline",
    show_default=True,
    help="Whether the gap counts to the wire's centreline or to its surface.",
)
@click.option(
    "--temperatures",
    help="Force against the wire's temperature at one gap, such as 0..80C; those at which the wire "
    "transforms are added to the points.",
)
@click.option("--output", "-o", type=click.Path(path_type=Path), help="Folder for curves.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON, and nothing else, to stdout.")
@click.option("--quiet", "-q", is_flag=True, help="Print nothing; with -o.")
def command(
    spec: Path,
    gaps: tuple[str, ...],
    gap_range: str | None,
    points: int,
    axis: str,
    poisson: float | None,
    measured_to: str,
    temperatures: str | None,
    output: Path | None,
    as_json: bool,
    quiet: bool,
) -> None:
    """Press one loop of the array in SPEC between two rigid plates, cold and hot.

    One gap gives the force, what touches and the loop's shape; several give a curve. -o writes
    tables and pictures.
    """
    import json

    from sesame_cad.actuation.folder import write_folder
    from sesame_cad.actuation.force import MeasuredTo, check_gap, vice
    from sesame_cad.actuation.summary import print_force
    from sesame_cad.progress import telling
    from sesame_cad.specification import load_specification
    from solver.errors import NotConvergedError
    from solver.plates import PlateAxis

    if quiet and output is None:
        raise InputError("--quiet: nothing would come of it; say with -o where to write")
    overrides = {} if poisson is None else {"fabric.poisson": poisson}
    specification = load_specification(spec, overrides)
    gaps_mm = _gaps_mm(gaps, gap_range, points)
    warm_C = _temperatures_C(temperatures, gaps_mm, points)  # noqa: N806
    held = vice(specification, PlateAxis(axis), MeasuredTo(measured_to))
    for gap_mm in gaps_mm:
        check_gap(specification, gap_mm, held.measured_to)
    try:
        with telling(quiet=quiet or as_json) as progress:
            progress("pressing the loop, cold and hot")
            data, files = _solve(held, gaps_mm, warm_C)
    except NotConvergedError as error:
        click.echo(f"error: {specification.name}: {error}", err=True)
        raise click.exceptions.Exit(1) from None
    if output is not None:
        data = write_folder(output, LISTING, data, files)
    if as_json:
        click.echo(json.dumps(data, indent=2, ensure_ascii=False))
    elif not quiet:
        print_force(data, output)


def _solve(
    held: Vice,
    gaps_mm: list[float],
    warm_C: list[float],  # noqa: N803
) -> tuple[dict[str, Any], dict[str, bytes]]:
    """Solve what is asked for; the tables and pictures of curves come with it."""
    from sesame_cad.actuation.force import (
        force_against_temperature,
        force_curve,
        force_point,
        with_transitions,
    )
    from sesame_cad.actuation.force_data import (
        curve_data,
        point_data,
        subject_data,
        temperature_data,
    )
    from sesame_cad.actuation.force_files import gap_files, temperature_files
    from sesame_cad.actuation.subject import transformation

    data = subject_data(held)
    if len(gaps_mm) == 1:
        cold, hot = (force_point(held, gaps_mm[0], fraction) for fraction in (0.0, 1.0))
        data |= {"gap_mm": gaps_mm[0]}
        data |= {"cold": point_data(held, cold), "hot": point_data(held, hot)}
        files = gap_files(held, [cold], [hot])
        if warm_C:
            law = transformation(held.spec)
            warm_C = with_transitions(law, warm_C)  # noqa: N806
            followed = force_against_temperature(held, law, gaps_mm[0], warm_C)
            data |= {"temperatures": temperature_data(held, followed)}
            files |= temperature_files(held, followed)
        return data, files
    falling = sorted(set(gaps_mm), reverse=True)
    both = [force_curve(held, [(gap, share) for gap in falling])[::-1] for share in (0.0, 1.0)]
    return data | {"curve": curve_data(held, *both)}, gap_files(held, *both)


def _gaps_mm(gaps: tuple[str, ...], gap_range: str | None, points: int) -> list[float]:
    """Read the gaps; all faults at once."""
    from sesame_cad.quantities import LENGTH_MM, parse_length_mm, parse_range

    if not gaps and gap_range is None:
        raise InputError("--gap: missing; give the distance of the plates, such as 20mm")
    found: list[float] = []
    faults: list[str] = []
    for text in gaps:
        try:
            found.append(parse_length_mm(text))
        except ValueError as error:
            faults.append(f"--gap: {error}")
    if gap_range is not None:
        try:
            found += _evenly(*parse_range(LENGTH_MM, gap_range), points)
        except ValueError as error:
            faults.append(f"--gaps: {error}")
    if faults:
        raise InputError(*faults)
    return found


def _temperatures_C(  # noqa: N802
    text: str | None, gaps_mm: list[float], points: int
) -> list[float]:
    from sesame_cad.quantities import TEMPERATURE_C, parse_range

    if text is None:
        return []
    if len(gaps_mm) > 1:
        raise InputError("--temperatures: needs one gap, not a curve of gaps")
    try:
        return _evenly(*parse_range(TEMPERATURE_C, text), points)
    except ValueError as error:
        raise InputError(f"--temperatures: {error}") from None


def _evenly(low: float, high: float, points: int) -> list[float]:
    """Points from one to the other, exact to what a person would write."""
    return [round(low + (high - low) * k / (points - 1), 9) for k in range(points)]
