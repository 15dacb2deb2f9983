"""``sesame-cad schema``: the JSON schema of specifications."""

from __future__ import annotations

import click


@click.command("schema")
def command() -> None:
    """Print the JSON schema of specifications, with which editors complete and check keys."""
    import json

    from sesame_cad.specification import json_schema

    click.echo(json.dumps(json_schema(), indent=2, ensure_ascii=False))
