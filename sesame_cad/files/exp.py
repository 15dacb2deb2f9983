"""Melco EXP: pairs of signed bytes."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence

from pyembroidery import ExpWriter

from patterns.records import Command, Records
from sesame_cad.errors import DesignFileError
from sesame_cad.files.byte_pairs import byte_pair_moves
from sesame_cad.files.embroidery import embroidery_pattern, records_of_moves
from sesame_cad.threads import Thread


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
    return byte_pair_moves(data, kinds, "EXP")
