"""Progress on the terminal while long work is done."""

from __future__ import annotations

from collections.abc import Callable, Generator
from contextlib import contextmanager

from rich.console import Console


@contextmanager
def telling(*, quiet: bool) -> Generator[Callable[[str], None]]:
    """Give a function that is told what is being done; a person at a terminal sees it.

    Nothing is shown when ``quiet``, or when the errors do not go to a terminal.
    """
    console = Console(stderr=True)
    if quiet or not console.is_terminal:
        yield lambda _: None
        return
    with console.status("starting") as status:
        yield lambda doing: status.update(f"{doing} …")
