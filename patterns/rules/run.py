"""All rules, one after the other."""

from __future__ import annotations

from patterns.circuit import Circuit, Diameters
from patterns.machine import Machine
from patterns.plan import StitchPlan
from patterns.rules.bend import check_bend_radius, check_smooth_path
from patterns.rules.clearance import check_needle_on_wire
from patterns.rules.contact_ties import check_contact_ties
from patterns.rules.couching_angle import check_couching_angle
from patterns.rules.cover_width import check_cover_width
from patterns.rules.feed import check_feed_and_cut
from patterns.rules.followed import check_wire_followed
from patterns.rules.holes import check_couching_holes
from patterns.rules.hoop import check_hoop
from patterns.rules.insulation import check_insulation
from patterns.rules.locks import check_locks
from patterns.rules.order import check_blocks
from patterns.rules.stitches import check_runs, check_stitch_length
from patterns.rules.subject import Subject
from patterns.stitching import Stitching
from patterns.violation import Violation

RULES = (
    check_blocks,
    check_runs,
    check_needle_on_wire,
    check_wire_followed,
    check_couching_angle,
    check_couching_holes,
    check_feed_and_cut,
    check_insulation,
    check_cover_width,
    check_contact_ties,
    check_stitch_length,
    check_locks,
    check_hoop,
    check_bend_radius,
    check_smooth_path,
)


def check_plan(
    circuit: Circuit,
    plan: StitchPlan,
    machine: Machine,
    stitching: Stitching,
    wire_diameter_mm: Diameters,
) -> tuple[Violation, ...]:
    """Check a stitch plan, as it will be sewn, against every rule.

    Only the plan's whole machine units are looked at, so a plan read from a file is checked like
    one just made.

    Returns
    -------
    tuple of Violation
        Empty when the plan can be sewn; in the order of the rules, then of the blocks.
    """
    subject = Subject(circuit, plan, machine, stitching, wire_diameter_mm)
    return tuple(violation for rule in RULES for violation in rule(subject))
