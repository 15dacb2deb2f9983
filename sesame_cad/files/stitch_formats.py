"""The stitch formats besides DST, and what each of them loses."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

import numpy as np

from patterns.records import LARGEST_STEP, Command, Records
from sesame_cad.errors import InputError
from sesame_cad.files import jef, pes, vp3
from sesame_cad.files.embroidery import without_travel
from sesame_cad.files.exp import read_exp, write_exp
from sesame_cad.files.u01 import read_u01, write_u01
from sesame_cad.threads import Thread

OtherFormat = Literal["exp", "u01", "pes", "jef", "vp3"]
"""Formats besides DST, by their suffix."""

FARTHEST = 32_767
"""Largest coordinate, in 0.1 mm, for which the headers of U01 and PES have room."""

MOST_BLOCKS = 250
"""PES and VP3 count their colours in a byte."""

NO_COLOURS = ("there are no colours: see the list of blocks",)


@dataclass(frozen=True)
class StitchFormat:
    """A format that is written by pyembroidery and decoded here.

    Attributes
    ----------
    write : callable
        From records and the thread of each block to the file.
    read : callable
        From the file to records; raises `DesignFileError`.
    carried : callable
        From records to those that the format can hold.
    losses : tuple of str
        What it cannot hold, in words.
    """

    write: Callable[[Records, Sequence[Thread]], bytes]
    read: Callable[[bytes], Records]
    carried: Callable[[Records], Records]
    losses: tuple[str, ...]


def _unchanged(records: Records) -> Records:
    return records


FORMATS = MappingProxyType[OtherFormat, StitchFormat](
    {
        "exp": StitchFormat(write_exp, read_exp, _unchanged, NO_COLOURS),
        "u01": StitchFormat(write_u01, read_u01, _unchanged, NO_COLOURS),
        "pes": StitchFormat(pes.write_pes, pes.read_pes, pes.carried_by_pes, pes.LOSSES),
        "jef": StitchFormat(jef.write_jef, jef.read_jef, _unchanged, jef.LOSSES),
        "vp3": StitchFormat(vp3.write_vp3, vp3.read_vp3, without_travel, vp3.LOSSES),
    }
)

LOSSES = MappingProxyType[str, tuple[str, ...]](
    {"dst": NO_COLOURS, **{kind: known.losses for kind, known in FORMATS.items()}}
)
"""What each format, DST too, does not hold of the plan."""


def write_embroidery(
    records: Records, file_format: OtherFormat, threads: Sequence[Thread]
) -> bytes:
    """Encode a design, and read it back before it is relied on.

    Parameters
    ----------
    threads
        One for each block, that is one more than there are stops.

    Raises
    ------
    InputError
        When the design is more than the format holds.
    """
    _check_room(records, threads)
    known = FORMATS[file_format]
    content = known.write(records, threads)
    found, expected = known.read(content), known.carried(records)
    same = np.array_equal(found.command, expected.command) and np.array_equal(found.xy, expected.xy)
    if not same:
        raise InputError(f"the {file_format.upper()} file does not hold the design: leave it out")
    return content


def _check_room(records: Records, threads: Sequence[Thread]) -> None:
    step = int(np.abs(np.diff(records.xy, axis=0, prepend=0)).max(initial=0))
    if step > LARGEST_STEP:
        raise InputError(f"a record moves {step / 10:.1f} mm; it can hold {LARGEST_STEP / 10} mm")
    reach = int(np.abs(records.xy).max(initial=0))
    if reach > FARTHEST:
        raise InputError(
            f"the design reaches {reach / 10:g} mm; formats other than DST go to {FARTHEST / 10} mm"
        )
    blocks = 1 + int(np.sum(records.command == Command.STOP))
    if not blocks == len(threads) <= MOST_BLOCKS:
        raise InputError(
            f"{blocks} blocks and {len(threads)} threads; formats other than DST hold one thread "
            f"for each of at most {MOST_BLOCKS} blocks"
        )
