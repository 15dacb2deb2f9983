from dataclasses import replace

import numpy as np
import pytest

from patterns.path import Line, WirePath
from patterns.plan import Run
from patterns.stitch_plan import stitch_plan


def test_a_jump_inside_a_wire_run_is_found(bench) -> None:
    circuit, plan = bench.good()
    (run,) = bench.block_of(plan, bench.first).runs
    lock = run.needles[[-2, -1, -2, -1]]
    again = Run((int(run.needles[-1, 0]), int(run.needles[-1, 1])), lock)
    jumped = bench.with_runs(plan, bench.first, run, again)
    assert bench.broken(circuit, jumped) == {"runs"}


def test_an_empty_run_is_found(bench) -> None:
    circuit, plan = bench.good()
    runs = bench.block_of(plan, bench.cover).runs
    empty = Run((0, 0), np.empty((0, 2), dtype=np.int64))
    assert bench.broken(circuit, bench.with_runs(plan, bench.cover, *runs, empty)) == {"runs"}


def test_long_and_short_stitches_are_found(bench) -> None:
    circuit, plan = bench.good()
    lock = ((2000, 2000), (2000, 2007), (2000, 2000))
    long = bench.with_mark(plan, *lock, (2122, 2000), (2122, 2007), (2122, 2000))
    assert bench.broken(circuit, long) == {"stitch-length"}
    slanted = bench.with_mark(plan, *lock, (2121, 2121), (2121, 2114), (2121, 2121))
    assert bench.broken(circuit, slanted) == set()
    short = bench.with_mark(plan, *lock, (2002, 2002), (2002, 2009), (2002, 2002))
    (fault,) = bench.check(circuit, short)
    assert fault.rule == "stitch-length"
    assert fault.actual == pytest.approx(0.08**0.5)


@pytest.mark.parametrize("end", ["begins", "ends"])
def test_a_thread_that_is_not_locked_is_found(bench, end: str) -> None:
    circuit, plan = bench.good()
    first, *others = bench.block_of(plan, bench.cover).runs
    cut = slice(2, None) if end == "begins" else slice(None, -2)
    loose = replace(first, needles=first.needles[cut])
    (fault,) = bench.check(circuit, bench.with_runs(plan, bench.cover, loose, *others))
    assert fault.rule == "locks"
    assert end in fault.message


def test_satin_alone_is_no_lock(bench) -> None:
    circuit, _ = bench.good()
    thin = replace(bench.machine, needle_diameter_mm=0.4)
    narrow = stitch_plan(circuit, bench.stitching, thin, bench.wire_mm, ())
    first, *others = bench.block_of(narrow, bench.cover).runs
    loose = replace(first, needles=first.needles[2:])
    assert np.hypot(*(loose.needles[1] - loose.needles[0])) <= 10
    unlocked = bench.with_runs(narrow, bench.cover, loose, *others)
    assert bench.broken(circuit, unlocked, machine=thin) == {"locks"}


def test_needles_and_jumps_stay_in_the_hoop(bench) -> None:
    circuit, plan = bench.good()
    faults = bench.check(circuit, plan, machine=replace(bench.machine, hoop_width_mm=150))
    assert {fault.rule for fault in faults} == {"hoop"}
    assert any(fault.stitch is not None for fault in faults)
    marks = bench.block_of(plan, bench.marks).runs
    far = replace(marks[0], approach=(int(marks[0].needles[0, 0]), 3001))
    near = replace(bench.machine, longest_stitch_mm=1e3)
    (fault,) = bench.check(
        circuit, bench.with_runs(plan, bench.marks, far, *marks[1:]), machine=near
    )
    assert (fault.rule, fault.stitch, fault.actual) == ("hoop", None, 300.1)


def test_a_tight_bend_is_found(bench) -> None:
    circuit, plan = bench.good()
    tight = replace(bench.stitching, smallest_bend_diameters=42.0)
    faults = bench.check(circuit, plan, stitching=tight)
    assert {fault.rule for fault in faults} == {"bend-radius"}
    assert faults[0].actual == pytest.approx(12.5)
    assert faults[0].allowed == pytest.approx(12.6)


def test_a_kink_is_found(bench) -> None:
    circuit, plan = bench.good()
    *arcs, tail = circuit.stages[1].pieces
    assert isinstance(tail, Line)
    along = np.array([tail.x1_mm - tail.x0_mm, tail.y1_mm - tail.y0_mm])
    x, y = np.array([tail.x0_mm, tail.y0_mm]) + along + 0.0011 * np.array([-along[1], along[0]])
    bent = WirePath((*arcs, replace(tail, x1_mm=float(x), y1_mm=float(y))))
    (fault,) = bench.check(replace(circuit, stages=(circuit.stages[0], bent)), plan)
    assert fault.rule == "smooth-path"
    assert (fault.x_mm, fault.y_mm) == pytest.approx((tail.x0_mm, tail.y0_mm))
