"""Melco EXP: pairs of signed bytes."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence

import numpy as np
from pyembroidery import ExpWriter

from patterns.records import Command, Records
from sesame_cad.errors import DesignFileError
from sesame_cad.files.embroidery import embroidery_pattern, records_of_moves, signed
from sesame_cad.threads import Thread

_CONTROL = 0x80


def write_exp(records: Records, _: Sequence[Thread]) -> bytes:
    """Encode a design; the format has no room for colours."""
    whole = io.BytesIO()
    ExpWriter.write(embroidery_pattern(records), whole)
    return whole.getvalue()


def read_exp(data: bytes) -> Records:
    """Decode a design.

    Raises
    ------
    DesignFileError
        When the data breaks off or holds a record of an unknown kind.
    """
    return records_of_moves(_moves(data))


def _moves(data: bytes) -> Iterator[tuple[Command, int, int]]:
    """Pairs of signed bytes; 80 hex announces a pair that is no stitch. Nothing marks the end."""
    kinds = {0x01: Command.STOP, 0x04: Command.JUMP}
    if len(data) % 2:
        raise DesignFileError(
            f"the EXP file breaks off in the middle of byte pair {len(data) // 2}"
        )
    pairs = iter(np.frombuffer(data, dtype=np.uint8).reshape(-1, 2).tolist())
    for x, y in pairs:
        if x != _CONTROL:
            yield Command.STITCH, signed(x), signed(y)
            continue
        moved = next(pairs, None)
        if y not in kinds or moved is None:
            raise DesignFileError(f"the EXP file holds an unknown or broken command {y:02X}")
        if kinds[y] is Command.STOP and any(moved):
            raise DesignFileError("the EXP file stops and moves at once")
        yield kinds[y], signed(moved[0]), signed(moved[1])
