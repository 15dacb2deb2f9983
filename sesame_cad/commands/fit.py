"""``sesame-cad fit``: which loop, wire and prestrain do what is wanted."""

from __future__ import annotations

from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import click

from sesame_cad.errors import InputError

if TYPE_CHECKING:
    from sesame_cad.fitting.actuator import Parts
    from sesame_cad.fitting.search import Bounds

_WANTED = MappingProxyType(
    {"height": "height_mm", "stroke": "stroke_mm", "pitch": "pitch_mm", "force": "force_N"}
)

_LIMITS = MappingProxyType(
    {
        "layout.loop_diameter_mm": (0.1, 10_000.0),
        "fabric.prestrain": (1e-3, 2.0),
        "wire.diameter_mm": (0.001, 10.0),
    }
)


@click.command("fit")
@click.option("--height", help="Height when cold, such as 12mm.")
@click.option("--stroke", help="Height that heating takes away, such as 4mm.")
@click.option("--pitch", help="Distance of loops after release, such as 30mm.")
@click.option("--force", help="Force of the hot loop held at its cold pitch, such as 0.5N.")
@click.option("--heights", type=click.Path(path_type=Path), help="CSV of mm by cell; with --pitch.")
@click.option("--loop-diameter", default="5mm:200mm", show_default=True, help="Or one value.")
@click.option("--prestrain", help="One value, or first:last. [that of --like, or 0.3]")
@click.option(
    "--wires", default="stock", show_default=True, help="stock, 0.3mm,0.5mm or 0.2mm:0.6mm."
)
@click.option("--like", type=click.Path(path_type=Path), help="Specification to take materials of.")
@click.option("--within", default="1%", show_default=True, help="Error that is allowed.")
@click.option(
    "--answers", type=click.IntRange(1, 50), default=5, show_default=True, help="At most."
)
@click.option("--json", "as_json", is_flag=True, help="Print JSON, and nothing else, to stdout.")
def command(
    heights: Path | None,
    loop_diameter: str,
    prestrain: str | None,
    wires: str,
    like: Path | None,
    within: str,
    answers: int,
    as_json: bool,
    **texts: str | None,
) -> None:
    """Find loops and wires that reach a wanted height, stroke, pitch or force; the best first.

    The wire is one from stock, or any within a range. What tolerances spoil least comes first. When
    nothing reaches what is wanted, the nearest is printed, and the exit code is 1.
    """
    import json

    from sesame_cad.fitting.heights import read_heights_mm
    from sesame_cad.fitting.report import fit_data, map_data
    from sesame_cad.progress import telling

    faults: list[str] = []
    wanted = _wanted(texts, faults)
    asked = {option for option, text in texts.items() if text is not None}
    if heights is None and not asked:
        faults.append("fit what? give --height, --stroke, --pitch, --force or --heights")
    if heights is not None and asked != {"pitch"}:
        faults.append("--heights: give --pitch with it, and nothing else that is wanted")
    parts, usual = _parts(like)
    bounds = _bounds(loop_diameter, prestrain or f"{usual:g}", wires, faults)
    share = _share(within, faults)
    if faults or bounds is None:
        raise InputError(*faults)
    with telling(quiet=as_json) as progress:
        progress("searching")
        if heights is not None:
            data = map_data(parts, read_heights_mm(heights), wanted["pitch_mm"], bounds, share)
        else:
            data = fit_data(parts, wanted, bounds, share, answers)
    if as_json:
        click.echo(json.dumps(data, indent=2))
    elif heights is not None:
        _print_answers(data["cells"])
        click.echo(f"note: {data['left_out']}")
    elif data["answers"]:
        _print_answers(data["answers"])
    if not data["feasible"]:
        click.echo(f"error: {_infeasible(data)}", err=True)
        raise click.exceptions.Exit(1)


def _quantity(option: str, key: str, text: str, faults: list[str]) -> float | None:
    from sesame_cad.quantities import parse_quantity

    try:
        return parse_quantity(key, text)
    except ValueError as error:
        faults.append(f"--{option}: {error}")
        return None


def _wanted(texts: dict[str, str | None], faults: list[str]) -> dict[str, float]:
    found: dict[str, float] = {}
    for option, key in _WANTED.items():
        text = texts[option]
        if text is None:
            continue
        value = _quantity(option, key, text, faults)
        if value is not None and not 0 < value < 1e6:
            faults.append(f"--{option}: {text!r}: must be greater than 0")
        elif value is not None:
            found[key] = value
    return found


def _parts(like: Path | None) -> tuple[Parts, float]:
    """Materials, and the prestrain that is usual with them."""
    from sesame_cad.fitting.actuator import Parts
    from sesame_cad.specification import load_specification
    from sesame_cad.specification.fabric import FabricSection
    from sesame_cad.specification.model import ModelSection
    from sesame_cad.specification.wire import WireSection

    if like is None:
        fabric, wire, model = FabricSection(), WireSection(diameter_mm=0.5), ModelSection()
    else:
        spec = load_specification(like)
        fabric, wire, model = spec.fabric, spec.wire, spec.model
    parts = Parts(
        fabric.modulus_kPa,
        fabric.thickness_mm,
        fabric.poisson,
        wire.modulus_cold_GPa,
        wire.modulus_hot_GPa,
        model.reading,
    )
    return parts, fabric.prestrain


def _bounds(loop: str, prestrain: str, wires: str, faults: list[str]) -> Bounds | None:
    from sesame_cad.fitting.search import Bounds
    from sesame_cad.scaling import STOCK_MM

    before = len(faults)
    loops = _range("loop-diameter", "layout.loop_diameter_mm", loop, faults)
    strains = _range("prestrain", "fabric.prestrain", prestrain, faults)
    if wires.strip() == "stock":
        chosen, any_wire = STOCK_MM, False
    elif ":" in wires:
        chosen, any_wire = _range("wires", "wire.diameter_mm", wires, faults), True
    else:
        listed = [_range("wires", "wire.diameter_mm", text, faults) for text in wires.split(",")]
        chosen, any_wire = tuple(sorted({low for low, _ in listed})), False
    if len(faults) > before:
        return None
    return Bounds(loops, strains, chosen, any_wire)


def _range(option: str, key: str, text: str, faults: list[str]) -> tuple[float, float]:
    """Read one value, or first:last."""
    ends = text.split(":")
    if len(ends) > 2:
        faults.append(f"--{option}: {text!r}: write one value, or first:last")
        return (0.0, 0.0)
    values = [_quantity(option, key, end, faults) for end in ends]
    known = [value for value in values if value is not None]
    if len(known) < len(values):
        return (0.0, 0.0)
    least, greatest = _LIMITS[key]
    if not least <= min(known) or not max(known) <= greatest:
        faults.append(f"--{option}: {text!r}: must be from {least:g} to {greatest:g}")
    elif known[0] > known[-1]:
        faults.append(f"--{option}: {text!r}: the first must not be greater than the last")
    return known[0], known[-1]


def _share(text: str, faults: list[str]) -> float:
    value = _quantity("within", "prestrain", text, faults)
    if value is not None and not 1e-6 <= value <= 0.5:
        faults.append(f"--within: {text!r}: must be from 0.0001% to 50%")
    return value or 0.0


def _infeasible(data: dict[str, Any]) -> str:
    if "cells" in data:
        bad = [cell for cell in data["cells"] if not cell["feasible"]]
        where = ", ".join(f"row {cell['row']} column {cell['column']}" for cell in bad[:3])
        more = f" and {len(bad) - 3} more" if len(bad) > 3 else ""
        return (
            f"{len(bad)} cells are out of reach ({where}{more}); each line shows the nearest; "
            "allow any wire (--wires 0.2mm:0.6mm), a larger --within, or choose another --pitch"
        )
    wanted = ", ".join(f"{key} = {value:g}" for key, value in data["wanted"].items())
    if not data["answers"]:
        return f"{wanted}: no loop within the bounds buckles and can be solved; widen them"
    nearest = data["answers"][0]
    limits = f"; at its bound: {', '.join(nearest['at_bounds'])}" if nearest["at_bounds"] else ""
    return (
        f"{wanted}: out of reach within the bounds; the nearest is off by "
        f"{100 * nearest['largest_error']:.2g} %{limits}"
    )


_WIDTH = 110

_COLUMNS = (
    ("row", "row", "{:d}"),
    ("col", "column", "{:d}"),
    ("wanted\nmm", "wanted_height_mm", "{:g}"),
    ("loop\nmm", "loop_diameter_mm", "{:.2f}"),
    ("wire\nmm", "wire_diameter_mm", "{:.3g}"),
    ("strain\n", "prestrain", "{:.3f}"),
    ("height\nmm", "height_mm", "{:.2f}"),
    ("stroke\nmm", "stroke_mm", "{:.2f}"),
    ("pitch\nmm", "pitch_mm", "{:.2f}"),
    ("force\nN", "force_N", "{:.3f}"),
    ("off\n", "largest_error", "{:.2%}"),
    ("height\n1 σ", "height_spread", "{:.1%}"),
)


def _print_answers(answers: list[dict[str, Any]]) -> None:
    from rich.console import Console
    from rich.table import Table

    table = Table(box=None, pad_edge=False)
    shown = [column for column in _COLUMNS if any(column[1] in answer for answer in answers)]
    for heading, _, _ in shown:
        table.add_column(heading, justify="right")
    for answer in answers:
        table.add_row(
            *(
                "" if answer.get(key) is None else style.format(answer[key])
                for _, key, style in shown
            ),
            "slack" if answer.get("slack") else "",
        )
    # as wide as its columns are, though a pipe has no width
    Console(highlight=False, width=_WIDTH).print(table)
