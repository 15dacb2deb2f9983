"""``sesame-cad new``: a commented starter specification."""

from __future__ import annotations

from pathlib import Path

import click

from sesame_cad.errors import InputError


@click.command("new")
@click.argument("name")
@click.option("--quiet", "-q", is_flag=True, help="Print nothing.")
def command(name: str, quiet: bool) -> None:
    """Write NAME.toml here: a specification to start from, with every key explained."""
    from sesame_cad.starter import starter_toml

    stem = name.removesuffix(".toml")
    text = starter_toml(stem)
    file = Path(f"{stem}.toml")
    try:
        with file.open("x", encoding="utf-8") as stream:
            stream.write(text)
    except FileExistsError:
        raise InputError(f"{file}: exists already, and is left as it is") from None
    except OSError as error:
        raise InputError(f"{file}: cannot be written: {error.strerror}") from None
    if not quiet:
        click.echo(f"wrote {file}; next: sesame-cad design {file}")
