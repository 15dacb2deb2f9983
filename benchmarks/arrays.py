"""Cost against size: square arrays with the fabric between the loops kept or cut, 1 × 1 to 20 × 20.

Run with ``python -m benchmarks.arrays``, one thread; it writes ``benchmarks/arrays.md`` and
``benchmarks/arrays.png``. Each array is solved in a process of its own, whose peak memory is told.
"""

from __future__ import annotations

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("OMP_NUM_THREADS", "1")

import json
import platform
import resource
import subprocess
import sys
from pathlib import Path
from time import perf_counter, process_time

import numpy as np
from matplotlib.figure import Figure

from solver.errors import NotConvergedError
from solver.mesh.array_mesh import Between
from solver.mesh.scene import ArrayScene
from solver.mesh.solve import solve_array, solve_loop_mesh
from solver.scene import LoopScene

HERE = Path(__file__).parent
LOOP = LoopScene(0.3, 0.0145, 0.3)
SIZES = (1, 2, 3, 4, 6, 8, 10, 14, 20)
SIZES_WITH_FIELD = (2, 3, 4, 6, 8, 10, 14, 20)
SIZES_CUT = (2, 6, 10, 20)
FINER = ((10, 28, 1), (10, 20, 2))
"""Loops along a side, edges of a loop and refinement of arrays that are solved on finer meshes."""
SEGMENTS, REFINEMENT = 20, 1
LONGEST = 90
"""Seconds after which a solve is given up."""
COLUMNS = (
    "loops",
    "edges a loop",
    "fabric",
    "triangles",
    "unknowns",
    "steps",
    "CPU s",
    "wall s",
    "peak MB",
    "energy a loop",
    "height/perimeter",
    "lowest eigenvalue",
    "compressed",
)
FINE_LOOPS = (0, 1, 2, 3, 4, 5, 6, 7)
PLAIN, FIELD, CUT = "plain fabric", "tension field", "gaps cut"
COLOURS = {PLAIN: "#0072B2", FIELD: "#D55E00", CUT: "#009E73"}


def measured(what, solve):
    """One row of the table: what it cost to solve, and what came out or why nothing did."""
    wall, cpu = perf_counter(), process_time()
    try:
        found = solve()
    except NotConvergedError as error:
        return {"what": what, "status": str(error)}
    return {
        "what": what,
        "status": found.status,
        "triangles": len(found.mesh.triangles),
        "unknowns": found.unknowns,
        "steps": found.steps,
        "cpu": process_time() - cpu,
        "wall": perf_counter() - wall,
        "megabytes": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
        "energy": found.energy,
        "height": found.height_over_perimeter,
        "lowest": found.lowest_eigenvalue,
        "compressed": found.compressed_fraction,
    }


def array(size, model, segments=SEGMENTS, refinement=REFINEMENT):
    """Solve one array and measure it."""
    between = Between.CUT if model == CUT else Between.KEPT
    scene = ArrayScene(LOOP, size, size, between)
    return measured(
        model,
        lambda: solve_array(
            scene, refinement=refinement, segments=segments, tension_field=model == FIELD
        ),
    ) | {"size": size, "edges": segments * 2**refinement}


def loop(refinement):
    """Solve one loop on a mesh of 20 · 4^refinement triangles and measure it."""
    return measured(f"k = {refinement}", lambda: solve_loop_mesh(LOOP, refinement=refinement))


def in_its_own_process(*arguments):
    """Row that a fresh process measures."""
    try:
        run = subprocess.run(
            [sys.executable, "-m", "benchmarks.arrays", *map(str, arguments)],
            cwd=HERE.parent,
            capture_output=True,
            text=True,
            check=True,
            timeout=LONGEST,
        )
    except subprocess.TimeoutExpired:
        what = {"status": f"given up after {LONGEST} s"}
        if len(arguments) == 1:
            return what | {"what": f"k = {arguments[0]}"}
        segments, refinement = arguments[2:] or (SEGMENTS, REFINEMENT)
        edges = segments * 2**refinement
        return what | {"what": arguments[1], "size": arguments[0], "edges": edges}
    return json.loads(run.stdout)


def exponent(rows):
    """Power of the unknowns with which CPU seconds grow, by least squares."""
    logs = np.log([[row["unknowns"], row["cpu"]] for row in rows])
    return float(np.polyfit(logs[:, 0], logs[:, 1], 1)[0])


def solved(rows, model):
    """Rows of a model that ended in a minimum, on meshes refined alike."""
    alike = [row for row in rows if row["edges"] == SEGMENTS * 2**REFINEMENT]
    return [row for row in alike if row["what"] == model and row["status"] == "converged"]


def draw(rows):
    """CPU seconds against unknowns, one line a model."""
    figure = Figure(figsize=(7, 5), layout="constrained")
    axes = figure.add_subplot()
    for model, colour in COLOURS.items():
        own = solved(rows, model)
        if len(own) < 2:
            continue
        axes.loglog(
            [row["unknowns"] for row in own],
            [row["cpu"] for row in own],
            "o-",
            color=colour,
            label=f"{model}, exponent {exponent(own):.2f}",
        )
        if model == PLAIN:
            for row in own:
                axes.annotate(
                    f"{row['size']} × {row['size']}",
                    (row["unknowns"], row["cpu"]),
                    xytext=(6, -10),
                    textcoords="offset points",
                    fontsize=8,
                )
    axes.set_xlabel("unknowns")
    axes.set_ylabel("CPU seconds, one thread")
    axes.margins(x=0.12)
    axes.set_title("Square arrays, 1 × 1 to 20 × 20 loops (ε = 0.3, β = 0.0145, ν = 0.3)")
    axes.grid(visible=True, which="both", alpha=0.2)
    axes.legend()
    figure.savefig(HERE / "arrays.png", dpi=120, metadata={"Software": None})


def cost(row):
    """Cells of a row that both tables have."""
    return (
        f"{row['triangles']} | {row['unknowns']} | {row['steps']} | {row['cpu']:.2g} | "
        f"{row['wall']:.2g} | {row['megabytes']:.0f}"
    )


def table(arrays, loops):
    """Markdown of everything measured."""
    yield "# Arrays, measured"
    yield ""
    yield "`python -m benchmarks.arrays`, one thread, each solve in a process of its own. Scene:"
    yield "ε = 0.3, β = 0.0145, ν = 0.3, fabric between the loops kept, or cut where that is said,"
    yield f"wires bonded. {platform.machine()}, Python {platform.python_version()}."
    yield "No contact: a shape may pass through itself, and large arrays, which roll up, do."
    yield "Each is a minimum: small gradient, no negative eigenvalue; with a tension field, no way"
    yield "down that gains 1e-8 of the energy. Arrays with their fabric kept are grown from smaller"
    yield "ones, which is in the cost, as is the mesh before the last, by which the error is told."
    yield ""
    yield "| " + " | ".join(COLUMNS) + " |"
    yield "|---" * len(COLUMNS) + "|"
    for row in arrays:
        n = row["size"]
        if row["status"] != "converged":
            told = row["status"].split(";")[0]
            yield f"| {n} × {n} | {row['edges']} | {row['what']} | {told} |" + " |" * 9
            continue
        yield (
            f"| {n} × {n} | {row['edges']} | {row['what']} | {cost(row)} | "
            f"{row['energy'] / n**2:.5f} | {row['height']:.4f} | "
            f"{row['lowest']:.1e} | {row['compressed']:.1%} |"
        )
    yield ""
    for model in COLOURS:
        own = solved(arrays, model)
        if len(own) > 1:
            yield f"* {model}: CPU seconds grow with the unknowns to the power {exponent(own):.2f}."
    yield ""
    yield "![CPU seconds against unknowns](arrays.png)"
    yield ""
    yield "One loop, from the coarsest mesh to the finest that is allowed:"
    yield ""
    yield "| mesh | triangles | unknowns | steps | CPU s | wall s | peak MB | height/perimeter |"
    yield "|---|---|---|---|---|---|---|---|"
    for row in loops:
        if row["status"] != "converged":
            yield f"| {row['what']} | {row['status']} | | | | | | |"
            continue
        yield f"| {row['what']} | {cost(row)} | {row['height']:.6f} |"


def main():
    if len(sys.argv) > 2:
        size, model, *mesh = sys.argv[1:]
        print(json.dumps(array(int(size), model, *map(int, mesh))))
        return
    if len(sys.argv) == 2:
        print(json.dumps(loop(int(sys.argv[1]))))
        return
    sizes = {PLAIN: SIZES, FIELD: SIZES_WITH_FIELD, CUT: SIZES_CUT}
    asked = [(n, model) for model, own in sizes.items() for n in own]
    asked += [(n, FIELD, *mesh) for n, *mesh in FINER]
    arrays = [in_its_own_process(*one) for one in asked]
    loops = [in_its_own_process(k) for k in FINE_LOOPS]
    draw(arrays)
    (HERE / "arrays.md").write_text("\n".join(table(arrays, loops)) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
