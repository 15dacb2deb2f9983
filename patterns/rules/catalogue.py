"""Every design rule in words: for the manual, and for whoever asks what a violation means."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class RuleNote:
    """A rule in words.

    Attributes
    ----------
    name : str
        As violations give it.
    checks : str
        What must hold.
    limit : str
        The limit and where it comes from.
    keys : tuple of str
        Keys of a specification that move the limit, or mend the fault.
    """

    name: str
    checks: str
    limit: str
    keys: tuple[str, ...]


CATALOGUE = (
    RuleNote(
        "blocks",
        "marks, stages of the wire, covers, stripes and ties are sewn once each and in order, a "
        "stop between two of them",
        "the circuit's own order",
        ("stitching.stripes", "stitching.ties"),
    ),
    RuleNote(
        "runs",
        "no block is empty; inside a run of wire the machine neither jumps nor trims",
        "one run a stage",
        ("machine.jumps_per_trim",),
    ),
    RuleNote(
        "needle-on-wire",
        "every needle point, those of locks too, misses its own wire and all wire laid before; "
        "marks miss all wire; of a swinging head both needle points do",
        "half the wire and half the needle",
        (
            "wire.diameter_mm",
            "machine.needle_diameter_mm",
            "machine.swing_mm",
            "stitching.needle_margin_mm",
        ),
    ),
    RuleNote(
        "wire-followed",
        "stitches cross their wire, left and right in turn, in order and from end to end (with a "
        "swinging head: lie on it), none too far from the next",
        "the couching interval",
        ("stitching.couching_interval_mm", "machine.couching"),
    ),
    RuleNote(
        "couching-angle",
        "on bends the wire turns little from one stitch to the next",
        "the couching angle; a chord of it is 1.5 % of the radius off the bend at 20 degrees",
        ("stitching.couching_angle_deg",),
    ),
    RuleNote(
        "couching-holes",
        "two holes after one another on one side of the wire do not run together",
        "a needle's diameter apart",
        ("machine.needle_diameter_mm", "stitching.couching_interval_mm"),
    ),
    RuleNote(
        "feed-and-cut",
        "the wire starts and ends straight, and nothing is sewn over its ends or lies at them",
        "10 mm of free wire, 5 mm from that of another circuit, for the crimps",
        ("stitching.tail_length_mm",),
    ),
    RuleNote(
        "insulation",
        "where stages of the wire come near each other, satin lies between them, without a gap",
        "wire surfaces nearer than the reach; gaps of 1.5 spacings",
        ("stitching.cover_reach_mm", "stitching.cover_spacing_mm"),
    ),
    RuleNote(
        "net",
        "wires and contacts that are rebuilt from the stitches alone lead from terminal to "
        "terminal, past no short circuit, with the resistance of the design",
        "3 % of the resistance; wires touch where their surfaces come within 0.14 mm",
        ("stitching.cover_reach_mm", "stitching.cover_spacing_mm"),
    ),
    RuleNote(
        "cover-width",
        "covers are as much wider than the couching as they are asked to be",
        "half the wire, half the needle and what the cover's margin exceeds the needle's by, on "
        "either side",
        ("stitching.cover_margin_mm", "stitching.needle_margin_mm"),
    ),
    RuleNote(
        "contact-ties",
        "where ties are asked for, every contact has one, across it from inside one loop to inside "
        "the other",
        "0.14 mm from the contact, twice what rounding moves a needle point",
        ("stitching.ties",),
    ),
    RuleNote(
        "stitch-length",
        "no stitch is longer along an axis, or shorter, than the machine sews",
        "12.1 mm at most, one record of a DST file; 0.3 mm at least, below which some machines "
        "drop the next stitch",
        ("machine.longest_stitch_mm", "machine.shortest_stitch_mm"),
    ),
    RuleNote(
        "locks",
        "every thread is locked where it begins and ends",
        "a stitch of at most 1 mm forth and back",
        ("stitching.lock_length_mm",),
    ),
    RuleNote(
        "hoop",
        "every needle point and every end of jumps lies in the field of the hoop",
        "the hoop without its rim",
        ("machine.hoop_width_mm", "machine.hoop_height_mm", "machine.hoop_rim_mm"),
    ),
    RuleNote(
        "bend-radius",
        "no bend of the wire is too tight",
        "a number of wire diameters",
        ("stitching.smallest_bend_diameters",),
    ),
    RuleNote(
        "smooth-path",
        "the wire has neither gap nor kink",
        "0.001 mm and 0.06 degrees",
        (),
    ),
    RuleNote(
        "cut-ring",
        "cut lines are rings that do not cross themselves, the outside one way round and the "
        "openings the other",
        "none",
        ("outline.margin_mm",),
    ),
    RuleNote(
        "cut-overlap",
        "openings lie inside the outside line, apart from one another",
        "none",
        ("outline.margin_mm",),
    ),
    RuleNote(
        "cut-margin",
        "cut lines keep away from the wire",
        "the margin",
        ("outline.margin_mm",),
    ),
    RuleNote(
        "cut-stitches",
        "needle points, but those of marks, lie on the fabric that is kept",
        "0.3 mm from a cut line",
        ("outline.margin_mm",),
    ),
    RuleNote(
        "ties",
        "one block of ties holds both edges of every loop of a sleeve to the layer above, each tie "
        "across the wire",
        "two ties an edge",
        ("sleeve.tie_angle_deg", "sleeve.tie_length_mm"),
    ),
    RuleNote(
        "tie-on-wire",
        "needle points of ties miss the wire of the upper layer too",
        "half the wire and half the needle",
        ("sleeve.tie_length_mm", "stitching.needle_margin_mm"),
    ),
    RuleNote(
        "tie-on-beam",
        "needle points of ties miss beams, hooks and their frame",
        "half the needle and the space that is asked for",
        ("sleeve.needle_to_beam_mm", "beam.width_mm", "layout.row_pitch_mm"),
    ),
    RuleNote(
        "beams-hoop",
        "beams and their frame lie in the field of the hoop",
        "the hoop without its rim",
        ("beam.frame_tabs", "beam.length_mm", "machine.hoop_width_mm", "machine.hoop_height_mm"),
    ),
    RuleNote(
        "cut-shape",
        "lines of a piece of sheet neither meet nor cross, and round corners have room",
        "none",
        ("beam.corner_radius_mm", "beam.hook_height_mm"),
    ),
    RuleNote(
        "hole-off",
        "holes lie on their piece",
        "none",
        ("beam.hole_diameter_mm", "beam.hole_edge_diameters"),
    ),
    RuleNote(
        "hole-edge",
        "beside a hole there is enough sheet",
        "diameters of the hole, from its edge",
        ("beam.hole_edge_diameters", "beam.width_mm"),
    ),
    RuleNote(
        "web",
        "sheet between two holes or lines is not too narrow",
        "0.8 mm, about twice the thickness of the published sheet",
        ("beam.length_mm",),
    ),
    RuleNote(
        "inner-radius",
        "a blade can follow inner corners and holes",
        "a radius of 0.25 mm",
        ("beam.hole_diameter_mm",),
    ),
    RuleNote(
        "hook-place",
        "hooks stand on the straight edges of a beam, apart from one another",
        "the edge between round corners",
        ("sleeve.compressed_pitch_mm", "beam.hook_height_mm"),
    ),
    RuleNote(
        "sleeve-length",
        "a compressed sleeve is no longer than half of its segment",
        "half the distance of the holes",
        ("sleeve.compressed_pitch_mm", "beam.length_mm"),
    ),
    RuleNote(
        "sleeve-place",
        "a compressed sleeve lies in one half of its segment, beside the hole",
        "the hole's edge and the middle",
        ("sleeve.compressed_pitch_mm", "beam.length_mm"),
    ),
    RuleNote(
        "constraint-length",
        "holes of a constraint strip are nearer to one another than those of the beam",
        "the distance of the beam's holes",
        ("beam.constraint_length_mm",),
    ),
    RuleNote(
        "constraint-window",
        "a beam with its hooks passes through the window of its constraint strip",
        "the beam's width with hooks",
        ("layout.loop_diameter_mm", "beam.hook_height_mm"),
    ),
    RuleNote(
        "mat-size",
        "every piece fits on the sheet, turned or not",
        "the sheet between its margins",
        ("beam.mat", "beam.sheet_width_mm", "beam.sheet_height_mm"),
    ),
    RuleNote("mat-edge", "nothing is cut beyond the sheet", "the sheet", ("beam.kerf_mm",)),
    RuleNote(
        "mat-overlap",
        "cuts of different pieces do not meet",
        "none",
        ("beam.spacing_mm", "beam.kerf_mm"),
    ),
)


def catalogue_table() -> str:
    """Write the rules as a table in Markdown."""
    rows = ["| rule | what it checks | limit | keys |", "|---|---|---|---|"]
    for note in CATALOGUE:
        keys = ", ".join(f"`{key}`" for key in note.keys) or "none"
        rows.append(f"| `{note.name}` | {note.checks} | {note.limit} | {keys} |")
    return "\n".join(rows)
