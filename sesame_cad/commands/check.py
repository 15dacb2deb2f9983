"""``sesame-cad check``: read a design back from disk and verify it."""

from __future__ import annotations

from pathlib import Path

import click


@click.command("check")
@click.argument("directory", type=click.Path(path_type=Path))
@click.option(
    "--faults",
    type=click.Path(path_type=Path),
    help="Picture (.svg or .png) to draw if the stitches break design rules.",
)
@click.option("--json", "as_json", is_flag=True, help="Print JSON, and nothing else, to stdout.")
@click.option("--quiet", "-q", is_flag=True, help="Say nothing when all is well.")
def command(directory: Path, faults: Path | None, as_json: bool, quiet: bool) -> None:
    """Verify every file of the design in DIRECTORY; one line per fault, exit code 1 if any."""
    import json

    from sesame_cad.faults import check_picture_name, draw_broken_rules
    from sesame_cad.progress import telling
    from sesame_cad.verification import verified

    if faults is not None:
        check_picture_name(faults)
    with telling(quiet=quiet or as_json) as progress:
        progress("making the design again, and reading every file")
        found = verified(directory)
    if as_json:
        click.echo(json.dumps({"faults": list(found.faults)}, indent=2, ensure_ascii=False))
    else:
        for line in found.faults:
            click.echo(line)
    if faults is not None and found.sewn is not None and found.violations:
        draw_broken_rules(faults, found.sewn.spec, found.sewn.pattern, found.violations)
    if found.faults:
        raise click.exceptions.Exit(1)
    if not (quiet or as_json):
        click.echo(f"{directory}: every file is as it should be")
