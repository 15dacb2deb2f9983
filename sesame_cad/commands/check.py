"""``sesame-cad check``: read a design back from disk and verify it."""

from __future__ import annotations

from pathlib import Path

import click


@click.command("check")
@click.argument("directory", type=click.Path(path_type=Path))
@click.option("--quiet", "-q", is_flag=True, help="Say nothing when all is well.")
def command(directory: Path, quiet: bool) -> None:
    """Verify every file of the design in DIRECTORY; one line per fault, exit code 1 if any."""
    from sesame_cad.verification import verify

    faults = verify(directory)
    for fault in faults:
        click.echo(fault)
    if faults:
        raise click.exceptions.Exit(1)
    if not quiet:
        click.echo(f"{directory}: every file is as it should be")
