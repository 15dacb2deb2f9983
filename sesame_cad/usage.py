"""Faults of the command line itself, in the words of all other faults."""

from __future__ import annotations

import re
from difflib import get_close_matches
from typing import Any

import click

_GIVEN = re.compile(r"'?(?P<value>.*?)'? is not ")
"""How click's own messages begin: with what was given."""


def usage_fault(error: click.ClickException) -> str:
    """Give the one line that says which option is wrong, what it holds, and what is allowed."""
    if not isinstance(error, click.BadParameter) or error.param is None:
        return error.format_message()
    name = _name(error.param)
    if isinstance(error, click.MissingParameter):
        return f"{name}: missing{_wanted(error.param, error.ctx)}"
    given = _GIVEN.match(error.message)
    problem = None if given is None else _problem(error.param.type, given["value"])
    return f"{name}: {problem or error.message}"


def _name(param: click.Parameter) -> str:
    """Give an option's long name, or an argument's in capitals."""
    return max(param.opts, key=len) if isinstance(param, click.Option) else str(param.name).upper()


def _wanted(param: click.Parameter, context: click.Context | None) -> str:
    if isinstance(param, click.Option):
        return f" ({param.help.rstrip('.')})" if param.help else ""
    return "" if context is None else context.get_usage().replace("Usage:", "; write", 1)


def _problem(kind: click.ParamType[Any, Any], value: str) -> str | None:
    match kind:
        case click.Choice():
            choices = [str(choice) for choice in kind.choices]
            near = get_close_matches(value, choices, 1)
            meant = f"; did you mean {near[0]}?" if near else ""
            return f"{value!r} must be one of {', '.join(choices)}{meant}"
        case click.IntRange():
            return f"{value!r} must be a whole number from {kind.min} to {kind.max}"
        case click.FloatRange():
            return f"{value!r} must be a number from {kind.min:g} to {kind.max:g}"
        case click.types.IntParamType():
            return f"{value!r} must be a whole number"
        case click.types.FloatParamType():
            return f"{value!r} must be a number"
        case _:
            return None
