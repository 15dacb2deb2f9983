"""Time and memory of n × n loops, planned, written and checked; run with ``python -m``.

Each size has a process of its own, so that its peak memory is its own. Writes ``scale.md`` and
``scale.png`` beside this file.
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
import tempfile
from pathlib import Path
from time import perf_counter, process_time

import numpy as np
from matplotlib.figure import Figure

from sesame_cad.package import write_package
from sesame_cad.pictures.canvas import png_bytes
from sesame_cad.specification import specification_from
from sesame_cad.verification import verify

SIZES = (5, 10, 20, 35, 50)
LOOP_MM, INTERVAL_MM = 105, 0.8
"""With these, 50 × 50 loops take more than a million stitches."""


def specification(size):
    hoop = LOOP_MM * size + 400
    return specification_from(
        {
            "wire": {"diameter_mm": 0.5},
            "layout": {
                "rows": size,
                "columns": size,
                "loop_diameter_mm": LOOP_MM,
                "shape": "none",
            },
            "stitching": {"couching_interval_mm": INTERVAL_MM},
            "machine": {"hoop_width_mm": hoop, "hoop_height_mm": hoop},
        },
        "scale",
        "benchmark",
    )


class Watch:
    """Wall and processor time of stages that are named when they begin."""

    def __init__(self):
        self.marks = []

    def __call__(self, name):
        self.marks.append((name, perf_counter(), process_time()))

    def stages(self):
        ends = self.marks[1:]
        return {
            name: (end[1] - wall, end[2] - processor)
            for (name, wall, processor), end in zip(self.marks, ends, strict=False)
        }


def measured(size):
    watch = Watch()
    with tempfile.TemporaryDirectory() as folder:
        data = write_package(specification(size), Path(folder) / "it", watch)
        watch("check")
        faults = verify(Path(folder) / "it")
        watch("end")
    if faults:
        raise SystemExit("\n".join(faults))
    return {
        "size": size,
        "stitches": data["stitch"]["stitches"],
        "megabytes": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
        "files_megabytes": sum(file["bytes"] for file in data["files"].values()) / 2**20,
        "stages": watch.stages(),
    }


def in_own_process(size):
    command = [sys.executable, "-m", "benchmarks.scale", str(size)]
    said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return json.loads(said)


def total(row, which):
    return sum(stage[which] for stage in row["stages"].values())


def exponent(rows, which):
    """Slope of the logarithm of time over that of stitches, on the three largest sizes."""
    x = np.log([row["stitches"] for row in rows[-3:]])
    return np.polyfit(x, np.log([total(row, which) for row in rows[-3:]]), 1)[0]


def table(rows):
    stages = list(rows[0]["stages"])
    yield "| loops | stitches | " + " | ".join(stages) + " | all | wall | peak MB | files MB |"
    yield "|---" * (len(stages) + 6) + "|"
    for row in rows:
        seconds = " | ".join(f"{row['stages'][stage][1]:.2f}" for stage in stages)
        yield (
            f"| {row['size']} × {row['size']} | {row['stitches']} | {seconds} | "
            f"{total(row, 1):.1f} | {total(row, 0):.1f} | {row['megabytes']:.0f} | "
            f"{row['files_megabytes']:.0f} |"
        )


def report(rows):
    yield "# Large arrays"
    yield ""
    yield (
        f"Made by `python -m benchmarks.scale`: square grids of {LOOP_MM} mm loops tied down every "
        f"{INTERVAL_MM} mm, without a shape. Seconds of processor time on one core by stage "
        "(`circuit and stitches` holds layout, wire, cut lines, plan and all design rules; `check` "
        "reads everything back and makes the design again); the wall clock ran on a machine that "
        "did other work too."
    )
    yield ""
    yield from table(rows)
    yield ""
    yield (
        f"Processor time grows with the {exponent(rows, 1):.2f}th power of the number of stitches "
        "over the three largest sizes."
    )
    yield ""
    yield "![Seconds over stitches](scale.png)"


def picture(rows):
    figure = Figure(figsize=(7.5, 4), layout="constrained")
    axes = figure.add_subplot()
    stitches = [row["stitches"] for row in rows]
    for stage in rows[0]["stages"]:
        axes.loglog(stitches, [row["stages"][stage][1] for row in rows], ".-", label=stage)
    axes.loglog(stitches, [total(row, 1) for row in rows], "k.-", linewidth=2, label="all")
    axes.loglog(stitches, [total(rows[-1], 1) / stitches[-1] * n for n in stitches], "k:")
    axes.set_xlabel("stitches (dotted: in proportion)")
    axes.set_ylabel("seconds of processor time")
    figure.legend(loc="outside right upper", fontsize=7)
    return png_bytes(figure)


def main():
    if len(sys.argv) > 1:
        print(json.dumps(measured(int(sys.argv[1]))))
        return
    rows = [in_own_process(size) for size in SIZES]
    here = Path(__file__).parent
    (here / "scale.md").write_text("\n".join(report(rows)) + "\n", encoding="utf-8")
    (here / "scale.png").write_bytes(picture(rows))
    print("\n".join(table(rows)))


if __name__ == "__main__":
    main()
