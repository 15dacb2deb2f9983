"""With which head, needle and colour each block is sewn."""

from __future__ import annotations

from dataclasses import dataclass

from patterns.plan import Block, BlockKind

# Okabe and Ito's colours, told apart by every kind of colour vision (Color Universal Design, 2008).
STAGES = ("#0072B2", "#D55E00", "#CC79A7", "#56B4E9", "#E69F00", "#8B5A2B")
"""Of the stages of the wire; after the last the first comes again."""

STAGE_NAMES = ("blue", "vermilion", "purple", "sky blue", "orange", "brown")
COVER, COVER_NAME = "#009E73", "green"
MARK, MARK_NAME = "#000000", "black"


@dataclass(frozen=True, slots=True)
class Thread:
    """What a block is sewn with. Stitch files and pictures show it in this colour.

    Attributes
    ----------
    material : str
        What is on the spool.
    head : str
        ``"wire"`` or ``"thread"``.
    needle : int
        Needle of the head, from 1.
    colour : str
        As in HTML, ``"#rrggbb"``.
    colour_name : str
    """

    material: str
    head: str
    needle: int
    colour: str
    colour_name: str


def thread_of(block: Block) -> Thread:
    """Give what a block is sewn with."""
    if block.kind is BlockKind.MARKS:
        return Thread("marking thread", "thread", 1, MARK, MARK_NAME)
    if block.kind is BlockKind.COVER:
        return Thread("cover thread", "thread", 2, COVER, COVER_NAME)
    k = block.stage % len(STAGES)
    material = f"shape-memory wire, stage {block.stage + 1}"
    return Thread(material, "wire", 1, STAGES[k], STAGE_NAMES[k])
