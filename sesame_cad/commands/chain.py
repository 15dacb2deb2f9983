"""``sesame-cad chain``: the curve of a chain of beams, each in one of its states."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from sesame_cad.errors import InputError

if TYPE_CHECKING:
    from sesame_cad.sleeve_prediction.chain import ChainCurve

_KINDS = (".svg", ".csv", ".json")


@click.command("chain")
@click.argument("spec", type=click.Path(path_type=Path))
@click.option(
    "--states", required=True, help="State of each segment in turn, + or -, such as ++-+."
)
@click.option(
    "--output",
    "-o",
    type=click.Path(path_type=Path),
    help="File to write, .svg, .csv or .json. [default: NAME-chain.svg]",
)
@click.option("--json", "as_json", is_flag=True, help="Print JSON, and nothing else, to stdout.")
@click.option("--quiet", "-q", is_flag=True, help="Print nothing.")
def command(spec: Path, states: str, output: Path | None, as_json: bool, quiet: bool) -> None:
    """Predict the plane curve of a chain of SPEC's beams, and write it 1:1.

    A segment in state + is arched up, to the left of the way along the chain. A file that exists is
    left as it is.
    """
    from sesame_cad.progress import telling
    from sesame_cad.sleeve_prediction.chain import chain_curve, chain_json
    from sesame_cad.specification import load_specification
    from sesame_cad.staging import write_new_file
    from solver.errors import NotConvergedError

    if output is not None and output.suffix.lower() not in _KINDS:
        raise InputError(f"--output: {output.name!r} must end in {', '.join(_KINDS)}")
    read = load_specification(spec)
    target = output or Path(f"{read.name}-chain.svg")
    try:
        with telling(quiet=quiet or as_json) as progress:
            progress("solving a segment")
            curve = chain_curve(read, states)
    except NotConvergedError as error:
        click.echo(f"error: {error}", err=True)
        raise click.exceptions.Exit(1) from None
    write_new_file(target, _content(curve, target.suffix.lower(), read.name).encode())
    if as_json:
        click.echo(chain_json(curve), nl=False)
    if as_json or quiet:
        return
    x, y = curve.rivets_mm[-1]
    click.echo(f"wrote {target}; it ends at {x:.1f}, {y:.1f} mm, turned by {curve.turn_deg:.1f}°")


def _content(curve: ChainCurve, kind: str, name: str) -> str:
    from sesame_cad.files.chain_svg import chain_svg
    from sesame_cad.sleeve_prediction.chain import chain_csv, chain_json

    if kind == ".svg":
        return chain_svg(curve, f"{name}: chain {curve.states}")
    return chain_csv(curve) if kind == ".csv" else chain_json(curve)
