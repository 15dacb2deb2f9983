"""Several circuits and their supply, from the specification to the folder and its check."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from patterns.electrics import ONE_SECOND_A, Drive, Supply, one_second_current_A
from patterns.plan import BlockKind, StitchPlan
from patterns.records import plan_records
from sesame_cad import package_checks, pipeline, verification
from sesame_cad.electrics_data import electrics_data
from sesame_cad.errors import InputError
from sesame_cad.pipeline import Design, pattern
from sesame_cad.specification import specification_from

GRID = {"rows": 2, "columns": 4, "loop_diameter_mm": 25, "shape": "none"}
LOW = {"name": "low", "cells": [[1, 1], [1, 2], [1, 3], [1, 4]]}
HIGH = {"name": "high", "cells": [[2, 1], [2, 2], [2, 3], [2, 4]], "wire_diameter_mm": 0.2}

FOLDER = """
name = "two"
[wire]
diameter_mm = 0.3
[layout]
rows = 2
columns = 3
loop_diameter_mm = 25
shape = "none"
[output]
pictures = false
[[wiring.circuits]]
name = "low"
cells = [[1, 1], [1, 2], [1, 3]]
[[wiring.circuits]]
name = "high"
cells = [[2, 1], [2, 2], [2, 3]]
terminals = "right"
wire_diameter_mm = 0.2
wire_resistivity_hot_uohm_cm = 90
"""


def specified(**sections):
    return specification_from({"wire": {"diameter_mm": 0.3}, "layout": GRID, **sections}, "x")


def faults(**sections):
    with pytest.raises(InputError) as caught:
        pattern(specified(**sections))
    assert all(len(fault.splitlines()) == 1 for fault in caught.value.faults)
    return caught.value.faults


def test_two_circuits_from_file_to_folder_and_check(tmp_path, run_command):
    (tmp_path / "two.toml").write_text(FOLDER)
    target = tmp_path / "out"
    code, said, _ = run_command(["design", str(tmp_path / "two.toml"), "-o", str(target)])
    assert code == 0
    assert "circuit high" in said
    data = json.loads((target / "design.json").read_text())
    assert [one["name"] for one in data["circuits"]] == ["low", "high"]
    assert [one["loops"] for one in data["circuits"]] == [[0, 1, 2], [3, 4, 5]]
    lengths = [one["wire_length_mm"] for one in data["circuits"]]
    assert data["circuit"]["wire_length_mm"] == pytest.approx(sum(lengths))
    assert data["circuit"]["covered_contacts"] == data["circuit"]["contacts"] == 7
    assert [one["contacts_with_earlier_circuits"] for one in data["circuits"]] == [0, 3]
    net = data["electrics"]["sewn_net"]
    assert (net["wires"], net["shorts"]) == (2, 0)
    designed = [one["resistance_ohm_cold"] for one in data["circuits"]]
    assert net["resistance_ohm_cold"] == pytest.approx(designed, rel=0.01)
    assert run_command(["check", str(target)])[0] == 0


def test_a_design_whose_stitches_short_is_refused_and_found(monkeypatch):
    spec = specified()
    made = Design(spec, pattern(spec), ())
    blocks = made.pattern.plan.blocks
    bare = tuple(
        replace(block, runs=block.runs[1:]) if block.kind is BlockKind.COVER else block
        for block in blocks
    )
    records = plan_records(StitchPlan(bare), spec.patterns_machine())
    reading = verification.Reading(Path(), {}, made)
    monkeypatch.setitem(vars(reading), "dst", records)
    assert any("net: short circuit" in fault for fault in package_checks._rule_faults(reading))
    monkeypatch.setattr(pipeline, "stitch_plan", lambda *_: StitchPlan(bare))
    assert any("net: short circuit" in fault for fault in faults())


@pytest.mark.parametrize(
    ("circuits", "message"),
    [
        ([LOW], "the loop in row 2 and column 1 is in no circuit, and 3 more"),
        ([LOW, {**HIGH, "cells": [*HIGH["cells"], [1, 4]]}], "is in circuits more than once"),
        ([LOW, {**HIGH, "name": "low"}], "2 circuits are called low"),
        ([LOW, {**HIGH, "cells": [[2, 5]]}], "there is no loop in row 2 and column 5"),
        ([LOW, {"name": "high", "loops": [4, 5, 6, 7]}], "name its loops by cells"),
        ([LOW, {"name": "high"}], "circuit high: it has no cells"),
        ([LOW, {**HIGH, "wire_diameter_mm": 0.9}], "wire_diameter_mm = 0.9 is too thick"),
        ([LOW, {**HIGH, "wire_colour": "red"}], "wiring.circuits"),
    ],
)
def test_circuits_that_will_not_do_are_said_in_one_line(circuits, message):
    assert any(message in fault for fault in faults(wiring={"circuits": circuits}))


def test_circuits_and_a_split_do_not_go_together():
    (fault,) = faults(wiring={"circuits": [LOW, HIGH], "split": "auto"})
    assert 'wiring.split = "auto": must be "none"' in fault


def test_other_wire_takes_another_shape():
    found = faults(layout={**GRID, "shape": "cell"}, wiring={"circuits": [LOW, HIGH]})
    assert any("circuit high is another" in fault for fault in found)


def test_an_array_in_pieces_is_told_how_to_be_several_circuits():
    layout = {**GRID, "missing": [[1, 2], [2, 2]]}
    (fault,) = faults(layout=layout)
    assert "is 25.000 mm apart" in fault
    assert 'wiring.split = "groups"' in fault
    laid = pattern(specified(layout=layout, wiring={"split": "groups"}))
    assert len(laid.circuit.parts) == 2


def test_as_many_circuits_as_the_supply_drives():
    whole = pattern(specified())
    driven = electrics_data(specified(), whole)
    (one,) = driven["circuits"]
    assert one["voltage_V"] == pytest.approx(one["current_A"] * 9.75, rel=0.05)
    low = {"voltage_V": 8.0, "current_A": 3.0}
    assert not electrics_data(specified(supply=low), whole)["drivable_together"]
    assert electrics_data(specified(supply=low), whole)["warnings"]
    split = specified(supply=low, wiring={"split": "auto"})
    laid = pattern(split)
    assert len(laid.circuit.parts) == 2
    assert electrics_data(split, laid)["warnings"] == []
    assert electrics_data(split, laid)["total_current_A"] <= 3.0
    (fault,) = faults(supply={"voltage_V": 8.0, "current_A": 2.0}, wiring={"split": "auto"})
    assert "current is enough for 1" in fault
    (fault,) = faults(supply={"current_A": 1.0}, wiring={"split": "auto"})
    assert "no circuit can be driven: the wire needs 1.42 A" in fault


def test_the_design_current_is_the_makers_and_a_power_law_between():
    for diameter, current in ONE_SECOND_A:
        assert one_second_current_A(diameter) == pytest.approx(current)
    middle = one_second_current_A((0.10 * 0.15) ** 0.5)
    assert middle == pytest.approx((0.20 * 0.41) ** 0.5)
    assert one_second_current_A(0.05) < 0.2
    assert one_second_current_A(0.6) > 4.0


def test_a_drive_says_what_the_supply_lacks():
    drive = Drive(current_A=2.0, resistance_ohm=10.0)
    assert (drive.voltage_V, drive.power_W) == (20.0, 40.0)
    assert drive.faults(Supply(20.0, 2.0)) == ()
    assert "need 20 V" in drive.faults(Supply(18.0, 3.0))[0]
    assert "needs 2 A" in drive.faults(Supply(20.0, 1.0))[0]
