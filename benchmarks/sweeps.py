"""Sweeps, fits and tolerances, measured; run with ``python -m benchmarks.sweeps``.

It writes ``benchmarks/sweeps.md``. Each line is a whole run of the program, start-up and pictures
included. Processor seconds are those of the run and of the workers that it started.
"""

from __future__ import annotations

import os
import platform
import resource
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

ROOT = Path(__file__).parents[1]
OUT = Path(__file__).with_suffix(".md")
LARGE = "examples/large-array.toml"
FINE = ["--strain", "0:0.5:200", "--beta", "0.01:0.25:200"]
RUNS = (
    ("25 × 26 of Fig. 2", ["sweep"], "default"),
    ("the same, plane stress", ["sweep", "--reading", "plane-stress", "--poisson", "0.45"], "ps"),
    ("the same again, all on disk", ["sweep"], "default"),
    ("200 × 200, one process", ["sweep", *FINE, "--workers", "0"], "one"),
    ("200 × 200, two workers", ["sweep", *FINE, "--workers", "2"], "two"),
    (
        "49 designs",
        [
            "sweep",
            LARGE,
            "--set",
            "layout.loop_diameter_mm=40:60:7",
            "--set",
            "wire.diameter_mm=0.4:0.6:7",
        ],
        "designs",
    ),
    ("scale", ["scale", "--wire-diameter", "0.3mm", "--like", LARGE], None),
    ("fit a height from stock", ["fit", "--height", "12mm"], None),
    ("fit height and stroke, any wire", ["fit", "--height", "12mm", "--stroke", "6mm"], "any"),
)


def measured(arguments):
    """Wall and processor seconds of a run."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), perf_counter()
    subprocess.run(
        [sys.executable, "-c", "from sesame_cad.cli import main; main()", *arguments],
        cwd=ROOT,
        check=True,
        capture_output=True,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )
    wall, after = perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return wall, used


def main():
    """Measure all runs, and compare the tables of the two large ones."""
    lines = [
        "# Sweeps, measured",
        "",
        "`python -m benchmarks.sweeps`: whole runs of the program, start-up and picture included.",
        f"{platform.machine()}, {len(os.sched_getaffinity(0))} processors, "
        f"Python {platform.python_version()}.",
        "",
        "| run | wall s | processor s |",
        "|---|---|---|",
    ]
    with TemporaryDirectory() as home:
        for name, arguments, folder in RUNS:
            more = ["-o", str(Path(home) / folder)] if arguments[0] == "sweep" else []
            if folder == "any":
                more = ["--wires", "0.2mm:0.6mm", "--prestrain", "0.1:0.5"]
            wall, used = measured([*arguments, *more])
            lines.append(f"| {name} | {wall:.1f} | {used:.1f} |")
        one, two = ((Path(home) / name / "sweep.csv").read_bytes() for name in ("one", "two"))
    same = "the same, byte for byte" if one == two else "DIFFERENT"
    load = os.getloadavg()[0]
    lines += [
        "",
        f"The tables of one process and of two workers are {same}.",
        "",
        f"Load of the machine at the end: {load:.1f}; above the number of processors, wall seconds",
        "are those of a machine that is shared, and processor seconds are what a run takes.",
        "",
    ]
    OUT.write_text("\n".join(lines), encoding="utf-8")


if __name__ == "__main__":
    main()
