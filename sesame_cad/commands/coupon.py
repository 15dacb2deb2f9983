"""``sesame-cad coupon``: a calibration coupon for a wire."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click


@click.command("coupon")
@click.option("--wire-diameter", required=True, help="Diameter of the wire, such as 0.3mm.")
@click.option("--machine", help="Profile, from sesame-cad machines, or a file that ends in .toml.")
@click.option(
    "--format", "formats", multiple=True, help="Stitch format: dst, exp, u01, pes, jef or vp3."
)
@click.option("--name", default="coupon", show_default=True, help="Name of the coupon.")
@click.option("--output", "-o", type=click.Path(path_type=Path), help="Folder to make. [NAME]")
@click.option("--json", "as_json", is_flag=True, help="Print design.json to stdout.")
@click.option("--quiet", "-q", is_flag=True, help="Print nothing.")
def command(
    wire_diameter: str,
    machine: str | None,
    formats: tuple[str, ...],
    name: str,
    output: Path | None,
    as_json: bool,
    quiet: bool,
) -> None:
    """Make a coupon to sew with your wire before the first array.

    Along one wire the couching gets wider (row W) and its stitches get farther apart (row I), and
    it crosses itself over wider and wider covers (row C). Pick the cells that hold; design.json
    and the picture say which value of which key each cell stands for.
    """
    import json

    from sesame_cad.coupon import write_coupon
    from sesame_cad.errors import InputError
    from sesame_cad.progress import telling
    from sesame_cad.quantities import parse_quantity
    from sesame_cad.specification import specification_from

    try:
        diameter = parse_quantity("wire.diameter_mm", wire_diameter)
    except ValueError as error:
        raise InputError(f"--wire-diameter: {error}") from None
    sections: dict[str, Any] = {
        "wire": {"diameter_mm": diameter},
        # what every specification has; the coupon has no loops and needs no room for them
        "layout": {"kind": "row", "columns": 1, "loop_diameter_mm": max(1.0, 50 * diameter)},
        "stitching": {"tail_length_mm": 15, "mark_size_mm": 3, "mark_gap_mm": 1},
        "output": {"formats": list(formats)},
    }
    if machine is not None:
        sections["machine"] = {"profile": machine}
    spec = specification_from(sections, name, "options")
    target = output or Path(name)
    with telling(quiet=quiet or as_json) as progress:
        progress("planning the coupon")
        data = write_coupon(spec, target)
    if as_json:
        click.echo(json.dumps(data, indent=2, ensure_ascii=False))
    if as_json or quiet:
        return
    cells, stitch = data["cells"], data["stitch"]
    click.echo(
        f"wrote {target}: {len(cells)} cells, {stitch['stitches']} stitches, "
        f"{data['wire_length_mm']:.0f} mm of wire"
    )
