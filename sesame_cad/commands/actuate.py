"""``sesame-cad actuate``: what the array does when its current flows."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from sesame_cad.errors import InputError

if TYPE_CHECKING:
    from sesame_cad.specification import Specification

LISTING = "actuation.json"


@click.command("actuate")
@click.argument("spec", type=click.Path(path_type=Path))
@click.option("--current", help="Current while it heats, such as 1.3A; 0A is none.")
@click.option("--load", help="Mass of a slab on the array, such as 40g.")
@click.option("--ambient", help="Temperature around the array, such as 25C.")
@click.option(
    "--calibrate",
    help="A measured point: current, time and temperature, such as 1.3A,10s,55C; cooling is "
    "adjusted to it.",
)
@click.option(
    "--output", "-o", type=click.Path(path_type=Path), help="Folder to make. [NAME-actuation]"
)
@click.option("--json", "as_json", is_flag=True, help="Print actuation.json to stdout.")
@click.option("--quiet", "-q", is_flag=True, help="Print nothing.")
def command(
    spec: Path,
    current: str | None,
    load: str | None,
    ambient: str | None,
    calibrate: str | None,
    output: Path | None,
    as_json: bool,
    quiet: bool,
) -> None:
    """Heat and cool the array in SPEC: temperature, height, load, time, power and supply.

    The folder holds actuation.json, tables of the curves and pictures. It is written aside and
    moved into place when it is complete.
    """
    import json

    from sesame_cad.actuation.course import actuate
    from sesame_cad.actuation.course_data import actuation_data
    from sesame_cad.actuation.course_files import actuation_files
    from sesame_cad.actuation.folder import write_folder
    from sesame_cad.actuation.summary import print_actuation
    from sesame_cad.progress import telling
    from sesame_cad.specification import load_specification
    from solver.errors import NotConvergedError

    given = _given(current=current, load=load, ambient=ambient)
    current_A = given.pop("current", None)  # noqa: N806
    overrides = {_KEYS[name]: value for name, value in given.items()}
    specification = load_specification(spec, overrides)
    if calibrate is not None:
        overrides["actuation.convection_W_m2K"] = _convection_W_m2K(specification, calibrate)
        specification = load_specification(spec, overrides)
    target = output or Path(f"{specification.name}-actuation")
    try:
        with telling(quiet=quiet or as_json) as progress:
            made = actuate(specification, current_A, progress)
            data = write_folder(target, LISTING, actuation_data(made), actuation_files(made))
    except NotConvergedError as error:
        click.echo(f"error: {specification.name}: {error}", err=True)
        raise click.exceptions.Exit(1) from None
    if as_json:
        click.echo(json.dumps(data, indent=2, ensure_ascii=False))
    elif not quiet:
        print_actuation(data, target)


_KEYS = {"load": "actuation.load_g", "ambient": "actuation.ambient_C"}


def _given(**texts: str | None) -> dict[str, Any]:
    """Read the options that carry units; all faults at once."""
    from sesame_cad.quantities import CURRENT_A, MASS_G, TEMPERATURE_C

    kinds = {"current": CURRENT_A, "load": MASS_G, "ambient": TEMPERATURE_C}
    values: dict[str, Any] = {}
    faults: list[str] = []
    for name, text in texts.items():
        if text is None:
            continue
        try:
            values[name] = kinds[name].parse(text)
        except ValueError as error:
            faults.append(f"--{name}: {error}")
    if values.get("current", 0.0) < 0:
        faults.append(f"--current: {values['current']:g} A must be at least 0")
    if faults:
        raise InputError(*faults)
    return values


def _convection_W_m2K(spec: Specification, text: str) -> float:  # noqa: N802
    """Find the coefficient that a measured point tells."""
    from sesame_cad.actuation.subject import heated_wire
    from sesame_cad.quantities import CURRENT_A, TEMPERATURE_C, TIME_S
    from solver.actuation.calibration import Measured, calibrated
    from solver.errors import SceneError

    parts = text.split(",")
    if len(parts) != 3:
        raise InputError(
            f"--calibrate: {text!r} must be current, time and temperature, such as 1.3A,10s,55C"
        )
    kinds = (CURRENT_A, TIME_S, TEMPERATURE_C)
    try:
        measured = Measured(*(kind.parse(part) for kind, part in zip(kinds, parts, strict=True)))
        around = calibrated(heated_wire(spec), spec.actuation.ambient_C, measured)
    except (ValueError, SceneError) as error:
        raise InputError(f"--calibrate: {error}") from None
    return around.convection_W_m2K
