"""``sesame-cad machines``: the machine profiles that come with the program."""

from __future__ import annotations

import click


@click.command("machines")
@click.argument("name", required=False)
@click.option("--json", "as_json", is_flag=True, help="Print names and what they are as JSON.")
def command(name: str | None, as_json: bool) -> None:
    """List the profiles for machine.profile, or print the one called NAME.

    Printed into a file, it is a profile of your own: machine.profile = "my.toml".
    """
    import json

    from sesame_cad.errors import InputError
    from sesame_cad.specification.profile import profile_names, profile_text

    if name is not None:
        if as_json:
            raise InputError("--json: lists the profiles; leave NAME out, or --json")
        click.echo(profile_text(name), nl=False)
        return
    says = {
        known: profile_text(known).partition("\n")[0].removeprefix("# ")
        for known in profile_names()
    }
    if as_json:
        click.echo(json.dumps(says, indent=2, ensure_ascii=False))
        return
    for known, what in says.items():
        click.echo(f"{known:24} {what}")
