"""``sesame-cad scale``: the same shape with another wire."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from sesame_cad.errors import InputError

_KEYS = {
    "wire_diameter": "wire.diameter_mm",
    "fabric_modulus": "fabric.modulus_kPa",
    "fabric_thickness": "fabric.thickness_mm",
    "wire_modulus_cold": "wire.modulus_cold_GPa",
    "wire_modulus_hot": "wire.modulus_hot_GPa",
}


@click.command("scale")
@click.option("--like", type=click.Path(path_type=Path), required=True, help="Specification.")
@click.option("--wire-diameter", required=True, help="The other wire's diameter, such as 0.3mm.")
@click.option("--fabric-modulus", help="The other fabric's modulus, if it differs: 700kPa.")
@click.option("--fabric-thickness", help="The other fabric's thickness, if it differs: 0.27mm.")
@click.option("--wire-modulus-cold", help="The other wire's modulus, if it differs: 28GPa.")
@click.option("--wire-modulus-hot", help="The other wire's hot modulus, if it differs: 75GPa.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON, and nothing else, to stdout.")
def command(like: Path, as_json: bool, **quantities: str | None) -> None:
    """Find the loop diameter of another wire at which β, and so the shape, is that of a design.

    β = E_w I_w/(2 E_f t R³), so that at equal materials d_w⁴/d_0³ stays as it is.
    """
    import json

    from sesame_cad.progress import telling
    from sesame_cad.scaling import Materials, scaled
    from sesame_cad.specification import load_specification
    from solver.errors import NotConvergedError, SceneError

    given = _given(quantities)
    specification = load_specification(like)
    wire_mm = given.pop("wire.diameter_mm")
    changed = Materials(**{key.replace(".", "_"): value for key, value in given.items()})
    try:
        with telling(quiet=as_json) as progress:
            progress("solving the loops")
            found = scaled(specification, wire_mm, changed)
    except SceneError as error:
        raise InputError(f"{specification.name}: {error}") from None
    except NotConvergedError as error:
        click.echo(f"error: {specification.name}: {error}", err=True)
        raise click.exceptions.Exit(1) from None
    if as_json:
        click.echo(json.dumps(found.data(), indent=2))
    else:
        _print(found.data())


def _given(quantities: dict[str, str | None]) -> dict[str, float]:
    from sesame_cad.quantities import parse_quantity

    values: dict[str, float] = {}
    faults: list[str] = []
    for option, text in quantities.items():
        if text is None:
            continue
        try:
            value = parse_quantity(_KEYS[option], text)
        except ValueError as error:
            faults.append(f"--{option.replace('_', '-')}: {error}")
            continue
        if value > 0:
            values[_KEYS[option]] = value
        else:
            faults.append(f"--{option.replace('_', '-')}: {text!r}: must be greater than 0")
    if faults:
        raise InputError(*faults)
    return values


_COLUMNS = (
    ("wire\nmm", "wire_diameter_mm", "{:g}"),
    ("loop\nmm", "loop_diameter_mm", "{:.2f}"),
    ("height\nmm", "height_mm", "{:.2f}"),
    ("bend\nmm", "smallest_bend_radius_mm", "{:.2f}"),
    ("Ω cold\na loop", "resistance_cold_ohm", "{:.3f}"),
    ("1 s\nA", "current_A", "{:.2f}"),
    ("W hot\na loop", "power_W", "{:.2f}"),
    ("E_f t R\nN", "force_unit_N", "{:.3f}"),
)

_CHANGES = (
    ("forces", "force_unit_N"),
    ("energies", "energy_unit_mJ"),
    ("resistance of a loop", "resistance_cold_ohm"),
    ("current that heats it in one second", "current_A"),
    ("smallest bend radius", "smallest_bend_radius_mm"),
    ("strain at the wire's surface", "wire_surface_strain"),
    ("weight over force", "weight_over_force_unit"),
)


def _print(data: dict[str, Any]) -> None:
    from rich.console import Console
    from rich.table import Table

    console = Console(highlight=False)
    console.print(f"loop diameter of equal β: {data['loop_diameter_mm']:.2f} mm")
    console.print(
        f"β cold {data['beta']:.5f}, hot {data['beta_hot']:.5f} "
        f"(the design's, hot: {data['like_beta_hot']:.5f})"
    )
    table = Table(box=None, pad_edge=False)
    for heading, _, _ in _COLUMNS:
        table.add_column(heading, justify="right")
    rows = [("design", data["like"]), ("asked", data["asked"])]
    rows += [("", loop) for loop in data["stock"]]
    table.add_column("")
    for name, loop in rows:
        table.add_row(*(style.format(loop[key]) for _, key, style in _COLUMNS), name)
    console.print(table)
    for what in data["similar"]:
        console.print(f"the same: {what}", soft_wrap=True)
    ratios = data["ratios"]
    for what, key in _CHANGES:
        console.print(f"not the same: {what} × {ratios[key]:.3g}")
    console.print(
        f"not the same: time to cool × {ratios['cooling_time_least']:.2g} to "
        f"{ratios['cooling_time_most']:.2g} (as d_w if the air takes heat alike, as d_w² if it "
        "takes it in inverse proportion to d_w)",
        soft_wrap=True,
    )
