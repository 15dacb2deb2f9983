"""What the stitch formats have in common: records in and out of the library's patterns."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
import pyembroidery
from numpy.typing import NDArray
from pyembroidery import EmbPattern, EmbThread

from patterns.records import Command, Records
from sesame_cad.threads import Thread

Indices = NDArray[np.intp]

_COMMANDS = {
    Command.STITCH: pyembroidery.STITCH,
    Command.JUMP: pyembroidery.JUMP,
    Command.STOP: pyembroidery.STOP,
    Command.END: pyembroidery.END,
}


def embroidery_pattern(records: Records) -> EmbPattern:
    """Give the records to pyembroidery as they are, with its y pointing to the operator."""
    pattern = EmbPattern()
    codes = np.zeros(len(records.command), dtype=np.int64)
    for command, code in _COMMANDS.items():
        codes[records.command == command] = code
    table = np.column_stack([records.xy * (1, -1), codes])
    # Straight into its list: every method that adds a stitch re-reads or normalises it.
    pattern.stitches.extend(table.tolist())
    return pattern


def coloured_pattern(records: Records, threads: Sequence[Thread]) -> EmbPattern:
    """Give the records with a colour change for each stop, and the thread of every block."""
    pattern = embroidery_pattern(records)
    for stitch in pattern.stitches:
        if stitch[2] == pyembroidery.STOP:
            stitch[2] = pyembroidery.COLOR_CHANGE
    # A block without a thread would get a random one.
    for thread in threads:
        pattern.add_thread(_library_thread(thread))
    return pattern


def _library_thread(thread: Thread) -> EmbThread:
    made = EmbThread()
    made.color = int(thread.colour.removeprefix("#"), 16)
    made.description = thread.material
    return made


def records_of_moves(moves: Iterable[tuple[Command, int, int]]) -> Records:
    """Add up displacements, from (0, 0), and end where they end."""
    found = [*moves]
    command = [*(str(what) for what, _, _ in found), str(Command.END)]
    step = [*((x, y) for _, x, y in found), (0, 0)]
    return Records(np.array(command), np.cumsum(np.array(step, dtype=np.int64), axis=0))


def without_travel(records: Records) -> Records:
    """Keep needle points and stops alone; the machine stops where it sewed last."""
    xy = records.xy.copy()
    last = np.maximum.accumulate(
        np.where(records.command == Command.STITCH, np.arange(len(xy)), -1)
    )
    xy[last >= 0] = records.xy[last[last >= 0]]
    xy[last < 0] = 0
    kept = records.command != Command.JUMP
    return Records(records.command[kept], xy[kept])


def run_starts(records: Records) -> Indices:
    """Where runs begin, after jumps, stops or the start, among the records `without_travel`."""
    sewing = records.command == Command.STITCH
    first = sewing & ~np.concatenate([[False], sewing[:-1]])
    return np.flatnonzero(first[records.command != Command.JUMP])


def signed(byte: int) -> int:
    """Read a byte as a number from -128 to 127."""
    return byte - 256 if byte > 127 else byte
