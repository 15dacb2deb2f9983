"""With which head, needle and colour each block is sewn."""

from __future__ import annotations

from dataclasses import dataclass, replace

from patterns.plan import Block, BlockKind, StitchPlan
from sesame_cad.colour_names import colour_name, rgb
from sesame_cad.specification.machine import MachineSection

THREADED = (BlockKind.MARKS, BlockKind.WIRE, BlockKind.COVER, BlockKind.STRIPES)
"""Kinds of blocks in the order of the machine's threads; ties are sewn with that of stripes."""

SHADES = 4
"""So many stages of the wire after one another have colours of their own."""

_SHADE = 0.18
_MIDDLE = 128


@dataclass(frozen=True, slots=True)
class Thread:
    """What a block is sewn with.

    Attributes
    ----------
    material : str
        What is laid or sewn.
    head : str
        ``"wire"`` or ``"thread"``; where a hand leads the wire there is one head, and the presser
        foot is named.
    needle : int
        Needle of the head, from 1.
    colour : str
        What stitch files show, as in HTML, ``"#rrggbb"``.
    spool : str, optional
        Colour of the thread itself, where files show a shade of it.
    """

    material: str
    head: str
    needle: int
    colour: str
    spool: str = ""

    @property
    def spool_colour(self) -> str:
        """Colour of the thread itself."""
        return self.spool or self.colour

    @property
    def colour_name(self) -> str:
        """Colour of the thread itself, in words."""
        return colour_name(self.spool_colour)

    @property
    def place(self) -> str:
        """Where the thread goes, in words."""
        return f"{self.head} head, needle {self.needle}" if " " not in self.head else self.head


def threads_of(plan: StitchPlan, machine: MachineSection) -> tuple[Thread, ...]:
    """Give what each block is sewn with, in the colours of the machine's threads.

    The thread that ties the wire is shown in another shade for each stage: some machines run on
    where a stop is a change to the same colour.
    """
    threads: list[Thread] = []
    for block in plan.blocks:
        own = _thread(block, machine)
        if threads and threads[-1].colour == own.colour:
            own = replace(own, colour=shade(own.colour, SHADES), spool=own.spool_colour)
        threads.append(own)
    return tuple(threads)


def _thread(block: Block, machine: MachineSection) -> Thread:
    marks, couching, covers, stripes = machine.threads
    if block.kind.is_wire:
        head = "cording foot" if machine.hand_guided else "wire"
        material = f"shape-memory wire, stage {block.stage + 1}"
        return Thread(material, head, 1, shade(couching, block.stage % SHADES), couching)
    material, needle, colour = {
        BlockKind.MARKS: ("marking thread", 1, marks),
        BlockKind.COVER: ("cover thread", 2, covers),
        BlockKind.STRIPES: ("thread that does not stretch", 3, stripes),
        BlockKind.TIES: ("thread that does not stretch", 3, stripes),
    }[block.kind]
    if machine.hand_guided:
        return Thread(material, "embroidery foot", 1, colour)
    return Thread(material, "thread", needle, colour)


def shade(colour: str, steps: int) -> str:
    """Take a colour some steps nearer to black if it is light, and to white if it is dark."""
    parts = rgb(colour)
    goal = 0 if sum(parts) > 3 * _MIDDLE else 255
    mixed = (round(part + (goal - part) * _SHADE * steps) for part in parts)
    return "#" + "".join(f"{part:02X}" for part in mixed)
