"""``sesame-cad design``: the fabrication package of an array."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import MappingProxyType
from typing import Any

import click

from sesame_cad.errors import InputError

QUANTITIES = MappingProxyType(
    {
        "loop_diameter": ("layout.loop_diameter_mm", "Diameter of a loop, such as 40mm."),
        "wire_diameter": ("wire.diameter_mm", "Diameter of the wire, such as 0.4mm."),
        "prestrain": ("fabric.prestrain", "Strain of the fabric in the hoop, such as 0.3 or 30%."),
        "poisson": ("fabric.poisson", "Poisson's ratio of the fabric."),
        "fabric_thickness": ("fabric.thickness_mm", "Thickness of the fabric, such as 0.27mm."),
        "fabric_modulus": ("fabric.modulus_kPa", "Modulus of the fabric, such as 700kPa."),
        "margin": ("outline.margin_mm", "Fabric left beside the wire, such as 2mm."),
        "tail_length": ("stitching.tail_length_mm", "Straight wire at each end, such as 40mm."),
        "hoop_width": ("machine.hoop_width_mm", "Inside width of the hoop, such as 16in."),
        "hoop_height": ("machine.hoop_height_mm", "Inside height of the hoop, such as 13in."),
    }
)
"""Options that take a quantity with its unit, and the key that each one sets."""


def _quantity_options(function: Callable[..., None]) -> Callable[..., None]:
    for name, (_, text) in reversed(list(QUANTITIES.items())):
        function = click.option(f"--{name.replace('_', '-')}", name, help=text)(function)
    return function


@click.command("design")
@click.argument("spec", required=False, type=click.Path(path_type=Path))
@click.option("--rows", type=int, help="Rows of loops.")
@click.option("--columns", type=int, help="Loops in a row.")
@_quantity_options
@click.option("--name", help="Name of the design; also of its folder.")
@click.option("--reading", type=str, help="plane-stress or published.")
@click.option(
    "--format", "formats", multiple=True, help="Stitch format: dst, exp, u01, pes, jef or vp3."
)
@click.option("--output", "-o", type=click.Path(path_type=Path), help="Folder to make. [NAME]")
@click.option(
    "--faults",
    type=click.Path(path_type=Path),
    help="Picture (.svg or .png) to draw if the plan breaks design rules.",
)
@click.option(
    "--tolerances",
    is_flag=True,
    help="Say what tolerances of moduli, strain and wire do to the height.",
)
@click.option("--json", "as_json", is_flag=True, help="Print design.json to stdout.")
@click.option("--quiet", "-q", is_flag=True, help="Print nothing.")
def command(
    spec: Path | None,
    rows: int | None,
    columns: int | None,
    name: str | None,
    reading: str | None,
    formats: tuple[str, ...],
    output: Path | None,
    faults: Path | None,
    tolerances: bool,
    as_json: bool,
    quiet: bool,
    **quantities: str | None,
) -> None:
    """Make the package of the array or sleeves in SPEC, a TOML file, or of the options alone.

    Options replace the file's keys. The package is a folder: design.json, stitch, cut, shape and
    pictures. It is written aside and moved into place when it is complete.
    """
    import json

    from sesame_cad.faults import check_picture_name, draw_broken_rules
    from sesame_cad.package import write_package
    from sesame_cad.pipeline import BrokenRulesError
    from sesame_cad.progress import telling
    from sesame_cad.sleeve.summary import print_sleeves
    from sesame_cad.summary import print_design
    from solver.errors import NotConvergedError

    plain: dict[str, Any] = {
        "name": name,
        "layout.rows": rows,
        "layout.columns": columns,
        "model.reading": reading,
        "output.formats": list(formats) or None,
    }
    overrides = {key: value for key, value in plain.items() if value is not None}
    specification = _specification(spec, overrides | _quantities(quantities))
    target = output or Path(specification.name)
    if faults is not None:
        check_picture_name(faults)
    with telling(quiet=quiet or as_json) as progress:
        progress("tolerances")
        spread = _tolerances(specification) if tolerances else None
    try:
        with telling(quiet=quiet or as_json) as progress:
            data = write_package(specification, target, progress)
    except BrokenRulesError as error:
        if faults is not None:
            draw_broken_rules(faults, specification, error.pattern, error.violations)
        raise
    except NotConvergedError as error:
        click.echo(f"error: {specification.name}: {error}", err=True)
        raise click.exceptions.Exit(1) from None
    if as_json:
        shown = data if spread is None else {**data, "tolerances": spread}
        click.echo(json.dumps(shown, indent=2, ensure_ascii=False))
    elif not quiet:
        (print_sleeves if "beams" in data else print_design)(data, target)
        if spread is not None:
            from sesame_cad.tolerances_summary import print_tolerances

            print_tolerances(spread)


def _tolerances(specification: Any) -> dict[str, Any]:
    """Reckon the heights' tolerances, before anything is written."""
    from sesame_cad.tolerances import tolerances_data
    from solver.errors import NotConvergedError, SceneError

    try:
        return tolerances_data(specification)
    except SceneError as error:
        raise InputError(f"{specification.name}: {error}") from None
    except NotConvergedError as error:
        click.echo(f"error: {specification.name}: {error}", err=True)
        raise click.exceptions.Exit(1) from None


def _quantities(given: dict[str, str | None]) -> dict[str, float]:
    """Read the options that carry units; all faults at once."""
    from sesame_cad.quantities import parse_quantity

    values: dict[str, float] = {}
    faults: list[str] = []
    for option, text in given.items():
        if text is None:
            continue
        key = QUANTITIES[option][0]
        try:
            values[key] = parse_quantity(key, text)
        except ValueError as error:
            faults.append(f"--{option.replace('_', '-')}: {error}")
    if faults:
        raise InputError(*faults)
    return values


def _specification(spec: Path | None, overrides: dict[str, Any]) -> Any:
    from sesame_cad.specification import load_specification, specification_from

    if spec is not None:
        return load_specification(spec, overrides)
    if not overrides:
        raise InputError("design what? give a specification (see sesame-cad new) or options")
    sections: dict[str, Any] = {}
    for keys, value in overrides.items():
        section, _, key = keys.partition(".")
        if key:
            sections.setdefault(section, {})[key] = value
        else:
            sections[section] = value
    layout = sections.get("layout", {})
    return specification_from(
        sections, f"grid-{layout.get('rows')}x{layout.get('columns')}", "options"
    )
