"""Colours of wire and thread in drawings, where kinds and stages must be told apart on white.

What is on the spools is another matter: see `sesame_cad.threads`.
"""

from __future__ import annotations

from patterns.plan import Block, BlockKind

# Okabe and Ito's colours, told apart by every kind of colour vision (Color Universal Design, 2008).
STAGES = ("#0072B2", "#D55E00", "#CC79A7", "#56B4E9", "#E69F00", "#8B5A2B")
"""Of the stages of the wire; after the last the first comes again."""

COVER, STRIPE, MARK = "#009E73", "#F0E442", "#000000"
TIE = "#B8860B"


def stage_colour(stage: int) -> str:
    """Colour of a stage of the wire, counted from 0."""
    return STAGES[stage % len(STAGES)]


def block_colour(block: Block) -> str:
    """Colour of the stitches of a block; those that tie wire have that of its stage."""
    if block.kind.is_wire:
        return stage_colour(block.stage)
    return {
        BlockKind.MARKS: MARK,
        BlockKind.COVER: COVER,
        BlockKind.STRIPES: STRIPE,
        BlockKind.TIES: TIE,
    }[block.kind]
