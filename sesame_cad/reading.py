"""A folder that is read back, beside the design that it should hold."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

from patterns.records import Records, plan_from_records, plan_records
from patterns.rules import check_plan
from patterns.rules.net import check_net
from patterns.violation import Violation
from sesame_cad.files.dst import decode_dst
from sesame_cad.pipeline import Design, net_of_stitches

MOST_BYTES = 500_000_000
"""No file of a design is larger, and a larger one is not read."""

Data = dict[str, Any]


@dataclass(frozen=True)
class Reading:
    """A folder under verification, and the design that it should hold."""

    folder: Path
    data: Data
    made: Design

    @cached_property
    def records(self) -> Records:
        """What the stitch files should hold."""
        return plan_records(self.made.pattern.plan, self.made.spec.patterns_machine())

    def content(self, path: str) -> bytes | None:
        """Bytes of a file; none when it is missing or too large, which `_check_files` reports."""
        file = self.folder / path
        good = file.is_file() and file.stat().st_size <= MOST_BYTES
        return file.read_bytes() if good else None

    def lack(self, path: str) -> str:
        """Say why a file has no content."""
        there = (self.folder / path).is_file()
        return f"more than {MOST_BYTES} bytes" if there else "missing"

    @cached_property
    def dst(self) -> Records | None:
        """What the DST file holds, if there is one; raises `DesignFileError`."""
        content = self.content(f"stitch/{self.made.spec.name}.dst")
        return (
            None if content is None else decode_dst(content, self.made.spec.dst_switches()).records
        )

    @cached_property
    def sewn(self) -> Design | None:
        """The design with the DST file's plan; raises `PatternError` when it is none."""
        if self.dst is None:
            return None
        laid = self.made.pattern
        plan = plan_from_records(self.dst, laid.plan.blocks)
        return replace(self.made, pattern=replace(laid, plan=plan))

    @cached_property
    def violations(self) -> tuple[Violation, ...]:
        """Hold what the DST file says against the design rules, whatever the plan was.

        The plan breaks none, or there would be no design: what holds the same records as the plan
        needs no second look.
        """
        if self.sewn is None or self.dst is None or self.dst.same_as(self.records):
            return ()
        spec, laid = self.sewn.spec, self.sewn.pattern
        machine, stitching = spec.patterns_machine(), spec.patterns_stitching()
        net = net_of_stitches(spec, laid.circuit, laid.plan)
        return (
            *check_plan(laid.circuit, laid.plan, machine, stitching, spec.diameters_mm),
            *check_net(laid.circuit, net),
        )
