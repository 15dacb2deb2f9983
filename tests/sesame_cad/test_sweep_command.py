import csv
import json
import os
import signal
import sys
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

from sesame_cad.pictures.phase_diagram import _runs
from sesame_cad.sweeps import arrays, here
from sesame_cad.sweeps.arrays import ArrayModel
from sesame_cad.sweeps.axis import parse_axis
from sesame_cad.sweeps.loops import KEYS, LoopModel
from sesame_cad.sweeps.outcome import Outcome, cells, outcome_of
from sesame_cad.sweeps.plan import SweepPlan
from sesame_cad.sweeps.store import SweepStore
from solver.compact import solve_loop
from solver.errors import NotConvergedError
from solver.reading import Reading
from solver.scene import LoopScene

SMALL = ["--strain", "0.1:0.3:3", "--beta", "0.02:0.06:5"]


@pytest.fixture
def large_spec():
    return str(Path(__file__).parents[2] / "examples" / "large-array.toml")


@pytest.fixture
def sweep(run_command, tmp_path):
    """Run a sweep, and give its data and its table's rows."""

    def run(*arguments, folder="out"):
        code, out, err = run_command(["sweep", *arguments, "-o", str(tmp_path / folder), "--json"])
        assert code == 0, err
        with (tmp_path / folder / "sweep.csv").open(newline="") as stream:
            return json.loads(out), list(csv.DictReader(stream))

    return run


def test_each_point_is_the_loop_of_its_numbers(sweep, tmp_path):
    data, rows = sweep(*SMALL)
    assert data["summary"]["points"] == len(rows) == 15
    assert [(float(row["strain"]), float(row["beta"])) for row in rows[:2]] == [
        (0.1, 0.02),
        (0.1, 0.03),
    ]
    for row in rows[::4]:
        scene = LoopScene(
            float(row["strain"]), float(row["beta"]), float(row["poisson"]), Reading.PUBLISHED
        )
        alone = solve_loop(scene, tolerance=1e-6)
        height = alone.shape.height_over_perimeter
        assert float(row["height_over_perimeter"]) == pytest.approx(height, rel=1e-3)
        assert row["buckled"] == ("yes" if alone.buckled else "no")
        assert row["status"] == "converged"
    assert (tmp_path / "out" / "sweep.png").read_bytes().startswith(b"\x89PNG")


def test_the_paper_s_point_has_the_paper_s_height(sweep):
    _, (row,) = sweep("--strain", "0.3", "--beta", "0.06")
    assert float(row["height_over_perimeter"]) == pytest.approx(0.154, abs=5e-4)


def test_unphysical_points_say_so(sweep):
    data, (slack, sound) = sweep("--strain", "0.5", "--beta", "0.01,0.1")
    assert slack["slack"] == "yes"
    assert slack["status"].startswith("not converged")
    assert (sound["slack"], sound["self_meeting"], sound["status"]) == ("no", "no", "converged")
    assert data["summary"]["not_converged"] == 1


def test_keys_of_a_specification(sweep, large_spec):
    keys = ["--set", "layout.loop_diameter_mm=4cm:50:2", "--set", "wire.diameter_mm=0.4,0.5"]
    _, rows = sweep(large_spec, *keys)
    last = rows[-1]
    assert (last["layout.loop_diameter_mm"], last["wire.diameter_mm"]) == ("50.0", "0.5")
    assert float(last["beta"]) == pytest.approx(0.01454, abs=1e-5)
    assert float(last["height_over_perimeter"]) == pytest.approx(0.1400, abs=1e-4)
    assert float(last["height_mm"]) == pytest.approx(0.1400 * 50 * 3.14159, rel=1e-3)
    _, (hot,) = sweep(large_spec, "--set", "wire.diameter_mm=0.5", "--state", "hot", folder="hot")
    assert float(hot["beta"]) / float(last["beta"]) == pytest.approx(75 / 28)


def test_a_design_that_cannot_be_says_so_and_the_others_stand(sweep, large_spec):
    _, rows = sweep(large_spec, "--set", "wire.diameter_mm=0.5,0.05")
    assert [row["status"] == "converged" for row in rows] == [True, False]
    assert rows[0]["height_mm"]


def test_loops_that_tile_are_as_one(sweep):
    loop = ["--strain", "0.3", "--beta", "0.02", "--reading", "plane-stress", "--poisson", "0.3"]
    _, (one,) = sweep(*loop, "--tolerance", "1e-4")
    _, (two,) = sweep("--loops", "1x2", *loop, "--tolerance", "1e-4", folder="two")
    assert two["status"] == "converged"
    assert float(two["height_over_perimeter"]) == pytest.approx(
        float(one["height_over_perimeter"]), rel=1e-4
    )
    assert float(two["energy"]) == pytest.approx(2 * float(one["energy"]), rel=1e-4)


def test_an_array_that_cannot_be_solved_says_so(monkeypatch):
    def fails(*_, **__):
        raise NotConvergedError("no mesh is fine enough")

    monkeypatch.setattr(arrays, "solve_scene", fails)
    model = ArrayModel(2, 2, "kept", "plane-stress", 0.1)
    (found,) = model.solve(KEYS, [(0.3, 0.02, 0.3, 1000.0)])
    assert (found.status, found.physical) == ("no mesh is fine enough", False)
    assert found.height_over_perimeter is None


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (["--beta", "0.1:0.2"], "--beta: '0.1:0.2' is no range"),
        (["--beta", "0.1:0.2:x"], "--beta: count 'x'"),
        (["--beta", "0.1:0.2:1"], "--beta: count '1'"),
        (["--beta", "0.1,0.1"], "--beta: '0.1,0.1' holds a value twice"),
        (["--beta", "0:0.2:3"], "beta = 0"),
        (["--strain", "0:3:4"], "strain = 3"),
        (["--strain", "0:1:2000", "--beta", "0.1:1:2000"], "4000000 points"),
        (["--set", "wire.diameter_mm=1"], "--set and --state are keys of a specification"),
        (["--loops", "0x3"], "--loops: '0x3'"),
        (["--tolerance", "nan"], "--tolerance: 'nan' must be a number"),
        (["--workers", "2", "--scheduler", "tcp://localhost:1"], "--workers starts processes"),
    ],
)
def test_bad_ranges(arguments, named, faults_of_command, tmp_path):
    (fault,) = faults_of_command(["sweep", *arguments, "-o", str(tmp_path / "out")])
    assert fault.startswith(f"error: {named}")
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        ([], "sweep what?"),
        (["--set", "wire.diametre_mm=1:2:3"], "--set wire.diametre_mm: no key"),
        (["--set", "layout.kind=1"], "--set layout.kind: no key"),
        (["--set", "wire.diameter_mm"], "--set 'wire.diameter_mm': write KEY=RANGE"),
        (["--set", "wire.diameter_mm=1kg"], "--set wire.diameter_mm: '1kg' is not a length"),
        (["--set", "fabric.prestrain=1:3:3"], "fabric.prestrain = 3: fabric.prestrain = 3"),
        (["--beta", "0.1", "--set", "fabric.prestrain=0.3"], "--beta: not with SPEC"),
    ],
)
def test_bad_keys(arguments, named, faults_of_command, large_spec, tmp_path):
    (fault,) = faults_of_command(["sweep", large_spec, *arguments, "-o", str(tmp_path / "out")])
    assert fault.startswith(f"error: {named}")


def test_values_that_a_person_would_write():
    assert parse_axis("strain", "0:0.5:26").values[3] == 0.06
    assert parse_axis("wire.diameter_mm", "300um, 0.4,0.02in").values == (0.3, 0.4, 0.508)


def test_cells_keep_every_bit():
    found = Outcome(0.1, 1 / 3, None, energy=1e-300, buckled=True, status='a "quoted", one')
    assert outcome_of(cells(found)) == found


PLAN = SweepPlan(
    LoopModel("plane-stress", 1e-3, points_at_once=40),
    (
        parse_axis("strain", "0.1:0.3:16"),
        parse_axis("beta", "0.02:0.05:20"),
        parse_axis("poisson", "0.3"),
        parse_axis("axial_stiffness", "1000"),
    ),
)


def test_an_interrupted_sweep_goes_on(run_command, tmp_path, monkeypatch):
    arguments = ["sweep", "--strain", "0.01:0.02:30", "--beta", "0.2:0.25:60", "--workers", "0"]
    code, _, err = run_command([*arguments, "-o", str(tmp_path / "whole"), "-q"])
    assert code == 0, err
    real, solved = here.solve_chunk, []

    def interrupted(*given):
        if solved:
            raise KeyboardInterrupt
        solved.append(given)
        return real(*given)

    monkeypatch.setattr(here, "solve_chunk", interrupted)
    code, _, err = run_command([*arguments, "-o", str(tmp_path / "out")])
    assert code == 130
    assert "1 of 2 parts are kept" in err
    assert not (tmp_path / "out" / "sweep.csv").exists()
    other = ["sweep", *SMALL, "-o", str(tmp_path / "out")]
    code, _, err = run_command(other)
    assert (code, "another sweep that is not finished" in err) == (2, True)

    again = []
    monkeypatch.setattr(here, "solve_chunk", lambda *given: again.append(given) or real(*given))
    assert run_command([*arguments, "-o", str(tmp_path / "out"), "-q"])[0] == 0
    assert len(again) == 1
    for name in ("sweep.csv", "sweep.png", "sweep.json"):
        assert (tmp_path / "out" / name).read_bytes() == (tmp_path / "whole" / name).read_bytes()
    # a finished one gives way
    assert run_command([*other, "-q"])[0] == 0


def test_a_chunk_cut_short_is_solved_again(tmp_path):
    few = parse_axis("strain", "0.1,0.2"), parse_axis("beta", "0.03")
    plan = SweepPlan(PLAN.model, (*few, *PLAN.axes[2:]))
    store = SweepStore(tmp_path / "out", plan)
    here.solve_here(plan, store.missing(), store.save)
    assert store.missing() == []
    (piece,) = (tmp_path / "out" / "chunks").iterdir()
    whole = piece.read_bytes()
    for cut in (whole[:-5], whole[: whole.index(b"\n") + 1]):
        piece.write_bytes(cut)
        assert store.missing() == [0]


def test_other_files_stay(faults_of_command, tmp_path):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "letter.txt").write_text("mine")
    (fault,) = faults_of_command(["sweep", *SMALL, "-o", str(tmp_path / "out")])
    assert "holds letter.txt" in fault
    assert (tmp_path / "out" / "letter.txt").read_text() == "mine"


def test_parquet_holds_the_same(sweep, tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet", reason="pyarrow is an optional extra")
    _, rows = sweep(*SMALL, "--parquet")
    table = parquet.read_table(tmp_path / "out" / "sweep.parquet").to_pydict()
    for name, read in (("energy", float), ("beta", float), ("status", str)):
        assert table[name] == [read(row[name]) for row in rows]
    assert table["buckled"] == [row["buckled"] == "yes" for row in rows]


@pytest.mark.skipif(sys.platform == "win32", reason="a terminal there asks in another way")
def test_ctrl_c_is_the_programs_and_not_its_workers():
    pytest.importorskip("distributed", reason="Dask is an optional extra")
    cluster = import_module("sesame_cad.sweeps.cluster")
    before = signal.getsignal(signal.SIGINT)
    with cluster.local_client(1) as client:
        assert signal.getsignal(signal.SIGINT) is before
        (workers_own,) = client.run(signal.getsignal, signal.SIGINT).values()
        (trim,) = client.run(os.environ.get, "MALLOC_TRIM_THRESHOLD_").values()
        (mmap,) = client.run(os.environ.get, "MALLOC_MMAP_THRESHOLD_").values()
    assert workers_own == signal.SIG_IGN
    # either alone has every large array fetched from the system anew
    assert int(trim) >= int(mmap) >= 1 << 25


@pytest.mark.skipif(sys.platform == "win32", reason="workers are killed by a signal")
def test_a_killed_worker_costs_only_time(tmp_path):
    pytest.importorskip("distributed", reason="Dask is an optional extra")
    cluster = import_module("sesame_cad.sweeps.cluster")
    alone = SweepStore(tmp_path / "alone", PLAN)
    here.solve_here(PLAN, alone.missing(), alone.save)
    shared = SweepStore(tmp_path / "shared", PLAN)
    killed = []
    with cluster.local_client(2) as client:

        def save(index, outcomes):
            if not killed:
                # both have chunks in hand: whichever dies, some are lost
                processes = client.run(os.getpid)
                killed.append(processes[min(processes)])
                os.kill(killed[0], signal.SIGKILL)
            shared.save(index, outcomes)

        cluster.solve_on(client, PLAN, shared.missing(), save)
        assert PLAN.chunks > 4
        assert killed[0] not in client.run(os.getpid).values()
    assert shared.table() == alone.table()


def test_runs_of_a_mask_cover_it_once():
    mask = np.random.default_rng(1).random((7, 9)) < 0.5
    mask[2], mask[4] = True, False
    covered = np.zeros(mask.shape, dtype=int)
    for row, first, last in _runs(mask):
        covered[row, first : last + 1] += 1
    assert (covered == mask).all()
    assert [run for run in _runs(mask) if run[0] in {2, 4}] == [(2, 0, 8)]
