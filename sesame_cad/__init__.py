"""Fabrication CAD for strained elastic surfaces with adjustable-modulus edges.

``sesame_cad.design("spec.toml")`` does what the command ``sesame-cad design`` does, and gives the
result as values; see `sesame_cad.designed.Designed`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sesame_cad.designed import Designed, design
    from sesame_cad.designed_sleeves import DesignedSleeves
    from sesame_cad.errors import InputError
    from solver.errors import NotConvergedError

__all__ = ["Designed", "DesignedSleeves", "InputError", "NotConvergedError", "design"]

_HOMES = {
    "Designed": "sesame_cad.designed",
    "DesignedSleeves": "sesame_cad.designed_sleeves",
    "design": "sesame_cad.designed",
    "InputError": "sesame_cad.errors",
    "NotConvergedError": "solver.errors",
}


def __getattr__(name: str) -> Any:
    """Load what is asked for when it is asked for: the command line imports this package too."""
    from importlib import import_module  # noqa: PLC0415 - so that --help stays quick

    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
