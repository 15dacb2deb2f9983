"""``sesame-cad machines``: the machine profiles that come with the program."""

from __future__ import annotations

import click


@click.command("machines")
@click.argument("name", required=False)
def command(name: str | None) -> None:
    """List the profiles for machine.profile, or print the one called NAME.

    Printed into a file, it is a profile of your own: machine.profile = "my.toml".
    """
    from sesame_cad.specification.profile import profile_names, profile_text

    if name is not None:
        click.echo(profile_text(name), nl=False)
        return
    for known in profile_names():
        says = profile_text(known).partition("\n")[0].removeprefix("# ")
        click.echo(f"{known:24} {says}")
