"""Records as pairs of signed bytes, as EXP and JEF hold them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from patterns.records import Command
from sesame_cad.errors import DesignFileError
from sesame_cad.files.embroidery import signed

CONTROL = 0x80
"""Announces a pair that is no stitch."""


def byte_pair_moves(
    pairs: bytes, kinds: Mapping[int, Command], name: str
) -> Iterator[tuple[Command, int, int]]:
    """Decode pairs of bytes to moves.

    Parameters
    ----------
    pairs
        An even number of bytes.
    kinds
        What the byte after a `CONTROL` says of the pair that follows.
    name
        Of the format, for messages.

    Raises
    ------
    DesignFileError
        When a command is unknown or breaks off, or a stop moves.
    """
    rest = iter(np.frombuffer(pairs, dtype=np.uint8).reshape(-1, 2).tolist())
    for x, y in rest:
        if x != CONTROL:
            yield Command.STITCH, signed(x), signed(y)
            continue
        moved = next(rest, None)
        if y not in kinds or moved is None:
            raise DesignFileError(f"the {name} file holds an unknown or broken command {y:02X}")
        if kinds[y] is Command.STOP and any(moved):
            raise DesignFileError(f"the {name} file stops and moves at once")
        yield kinds[y], signed(moved[0]), signed(moved[1])
