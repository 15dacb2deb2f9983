"""The command line: each command is a module of `sesame_cad.commands`, loaded when it is used."""

from __future__ import annotations

import signal
import sys
from importlib import import_module
from types import FrameType, MappingProxyType
from typing import NoReturn

import click

from sesame_cad.errors import InputError

COMMANDS = MappingProxyType(
    {
        "new": "Write a commented starter specification.",
        "design": "Make the fabrication package of an array.",
        "check": "Read a design back from disk and verify every file.",
        "solve": "Solve one dimensionless loop.",
        "chain": "Write the curve of a chain of beams, each in one of its states.",
        "force": "Press one loop between plates, cold and hot.",
        "actuate": "Heat the array: height, load, time and power.",
        "sweep": "Solve a grid of loops or of designs: table and phase diagram.",
        "scale": "Find the loop of another wire that takes the same shape.",
        "fit": "Find loops and wires that reach a wanted height, stroke, pitch or force.",
        "export-evolver": "Write loops as a datafile of Surface Evolver.",
        "machines": "List machine profiles, or print one to start your own from.",
        "coupon": "Make a coupon to find the settings for your wire.",
        "schema": "Print the JSON schema of specifications, for editors.",
    }
)
"""Names and one-line descriptions, so that ``--help`` need not load the commands."""

BAD_INPUT = 2
FAILED = 1
INTERRUPTED = 130


class LazyGroup(click.Group):
    """A group that imports a command when it is called or asked for help."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Names in the order of the work."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import ``sesame_cad.commands.<name>``, with _ for -, and take its ``command``."""
        if cmd_name not in COMMANDS:
            return None
        module = import_module(f"sesame_cad.commands.{cmd_name.replace('-', '_')}")
        command: click.Command = module.command
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command; of an unknown one, name the nearest."""
        import difflib

        if args and args[0] not in COMMANDS and not args[0].startswith("-"):
            near = difflib.get_close_matches(args[0], COMMANDS, n=1)
            hint = f"did you mean {near[0]}?" if near else f"one of {', '.join(COMMANDS)}"
            raise click.UsageError(f"no command {args[0]!r}; {hint}")
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """List the commands without importing them."""
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))


@click.command(cls=LazyGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="sesame-cad", prog_name="sesame-cad")
def cli() -> None:
    """Fabrication CAD for SESAMEs: strained elastic surfaces with adjustable-modulus edges.

    From a loop grid to stitch file, cut outline, predicted shape and STL.
    """


def main() -> None:
    """Run the command line; bad input is one line per fault and exit code 2."""
    signal.signal(signal.SIGTERM, _interrupt)
    try:
        status = cli.main(standalone_mode=False)
    except InputError as error:
        _say(error.faults)
        status = BAD_INPUT
    except click.exceptions.Abort:
        _say(("interrupted; nothing was changed",))
        status = INTERRUPTED
    except click.ClickException as error:
        from sesame_cad.usage import usage_fault

        _say((usage_fault(error),))
        status = BAD_INPUT
    except OSError as error:
        _say((f"{error.filename or 'writing'}: {error.strerror}",))
        status = FAILED
    sys.exit(status if isinstance(status, int) else 0)


def _say(lines: tuple[str, ...]) -> None:
    for line in lines:
        click.echo(f"error: {line}", err=True)


def _interrupt(_signal: int, _frame: FrameType | None) -> NoReturn:
    """Treat the request to end like Ctrl-C, so that half-made files are taken away."""
    raise KeyboardInterrupt
