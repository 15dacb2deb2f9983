"""Error against time: every rung of the ladder, and Surface Evolver in the same run.

Run with ``python -m benchmarks.ladder``, one thread; it writes ``benchmarks/ladder.md`` and
``benchmarks/ladder.png``. Surface Evolver's lines need ``evolver-nox-d`` on the path.
"""

from __future__ import annotations

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("OMP_NUM_THREADS", "1")

import platform
import re
import resource
import shutil
import subprocess
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter

import numpy as np
from matplotlib.figure import Figure

from sesame_cad.files.evolver import evolver_datafile
from solver.compact import solve_loop
from solver.held import held_path
from solver.many import solve_many
from solver.mesh.array_mesh import Between
from solver.mesh.scene import ArrayScene
from solver.mesh.solve import solve_array, solve_loop_mesh
from solver.plates import PlateAxis, Plates
from solver.scaling_law import scaling_height
from solver.scene import LoopScene

HERE = Path(__file__).parent
SCENE = LoopScene(0.3, 0.0145, 0.3)
EVOLVER = shutil.which("evolver-nox-d") or shutil.which("evolver-nox")
COLOURS = {
    "scaling law": "#999999",
    "compact, cold": "#0072B2",
    "mesh": "#009E73",
    "Surface Evolver": "#D55E00",
}


@dataclass(frozen=True)
class Point:
    """One solve: which line of the picture, what it was, seconds, relative error of the height."""

    line: str
    what: str
    seconds: float
    error: float


def best_of(repeats, work):
    """Shortest of a few times, and the last result."""
    times = []
    for _ in range(repeats):
        start = perf_counter()
        result = work()
        times.append(perf_counter() - start)
    return min(times), result


def rungs(exact):
    """Every rung at the scene of `SCENE`."""

    def error(height):
        return abs(height / exact - 1)

    seconds, height = best_of(
        200, lambda: scaling_height(SCENE.strain, SCENE.beta, SCENE.poisson, SCENE.reading)
    )
    yield Point("scaling law", "law", seconds, error(height))
    for tolerance in (1e-2, 1e-4, 1e-6):
        solve_loop(SCENE, tolerance=tolerance)  # the bases' tables are made once
        seconds, found = best_of(20, lambda t=tolerance: solve_loop(SCENE, tolerance=t))
        what = f"{found.unknowns} unknowns"
        yield Point("compact, cold", what, seconds, error(found.shape.height_over_perimeter))
    for k in (1, 2, 3, 4, 5):
        seconds, found = best_of(3, lambda k=k: solve_loop_mesh(SCENE, refinement=k))
        what = f"k = {k}, {found.unknowns} unknowns"
        yield Point("mesh", what, seconds, error(found.height_over_perimeter))
    if EVOLVER:
        for k in (1, 2, 3, 4):
            seconds, height = best_of(3, lambda k=k: by_evolver(SCENE, k))
            yield Point("Surface Evolver", f"k = {k}", seconds, error(height))


def by_evolver(scene, refinements):
    """Height over perimeter by Surface Evolver, one process with its start."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "loop.fe"
        file.write_text(evolver_datafile(scene, refinements))
        run = subprocess.run(
            [EVOLVER, file.name],
            cwd=folder,
            input="solve\nq\nq\n",
            capture_output=True,
            text=True,
            check=False,
            timeout=600,
        )
    found = re.findall(r"height_over_perimeter\s+([-\d.eE+]+)", run.stdout)
    return float(found[-1])


def warm_seconds():
    """A solve from its neighbour's shape."""
    near = solve_loop(replace(SCENE, beta=0.015))
    return best_of(20, lambda: solve_loop(SCENE, start=near))[0]


def grid_of_figure_2():
    """Seconds for the 25 × 26 points of the paper's Fig. 2, at 1e-3."""
    strain, beta = np.meshgrid(np.linspace(0, 0.5, 26), np.linspace(0.01, 0.25, 25))
    return best_of(3, lambda: solve_many(strain.ravel(), beta.ravel(), 0.3, tolerance=1e-3))[0]


def path_of_held_states(states=50):
    """Seconds for a loop pressed flat by two plates, gap after gap, each from the one before."""
    free = solve_loop(SCENE).shape.height
    gaps = np.linspace(0.99, 0.3, states) * free
    path = [(SCENE, Plates(float(gap), PlateAxis.HEIGHT)) for gap in gaps]
    return best_of(1, lambda: list(held_path(path)))[0]


def kept_arrays(sizes):
    """Rows (loops, triangles, unknowns, seconds) of square arrays with the fabric kept."""
    for n in sizes:
        scene = ArrayScene(SCENE, n, n, Between.KEPT)
        seconds, found = best_of(1, lambda s=scene: solve_array(s, refinement=1))
        yield n, len(found.mesh.triangles), found.unknowns, seconds


def draw(points):
    """Error against time, one line a rung."""
    figure = Figure(figsize=(7, 5), layout="constrained")
    axes = figure.add_subplot()
    for line, colour in COLOURS.items():
        own = [p for p in points if p.line == line]
        if own:
            axes.loglog(
                [p.seconds for p in own], [max(p.error, 1e-8) for p in own], "o-", color=colour
            )
            axes.annotate(
                line,
                (own[-1].seconds, max(own[-1].error, 1e-8)),
                color=colour,
                xytext=(6, 6),
                textcoords="offset points",
            )
    axes.set_xlabel("seconds, one thread")
    axes.set_ylabel("relative error of the height")
    axes.set_title("ε = 0.3, β = 0.0145, ν = 0.3")
    axes.grid(visible=True, which="both", alpha=0.2)
    figure.savefig(HERE / "ladder.png", dpi=120, metadata={"Software": None})


def table(points, extra, arrays):
    """Markdown of everything measured."""
    yield "# The ladder, measured"
    yield ""
    yield "`python -m benchmarks.ladder`, one thread, the solve alone (tables of the bases made"
    yield "before; Surface Evolver with the start of its process). Scene: ε = 0.3, β = 0.0145,"
    yield f"ν = 0.3. {platform.machine()}, Python {platform.python_version()}."
    yield ""
    yield "| rung | what | seconds | relative error of the height |"
    yield "|---|---|---|---|"
    for p in points:
        yield f"| {p.line} | {p.what} | {p.seconds:.2g} | {p.error:.1e} |"
    yield ""
    yield "![error against time](ladder.png)"
    yield ""
    yield "| also | seconds |"
    yield "|---|---|"
    for name, seconds in extra.items():
        yield f"| {name} | {seconds:.2g} |"
    yield ""
    yield "Square arrays with the fabric between the loops kept, edges k = 1:"
    yield ""
    yield "| loops | triangles | unknowns | seconds |"
    yield "|---|---|---|---|"
    for n, triangles, unknowns, seconds in arrays:
        yield f"| {n} × {n} | {triangles} | {unknowns} | {seconds:.2g} |"
    if len(arrays) > 1:
        slope = np.polyfit(np.log([a[2] for a in arrays]), np.log([a[3] for a in arrays]), 1)[0]
        yield ""
        yield f"Seconds grow with the unknowns to the power {slope:.2f}."
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    yield ""
    yield f"Peak memory of the whole run: {peak:.0f} MB."


def main():
    exact = solve_loop(SCENE, tolerance=1e-8).shape.height_over_perimeter
    points = list(rungs(exact))
    extra = {
        "compact from a neighbouring solution": warm_seconds(),
        "25 × 26 points of Fig. 2, at 1e-3": grid_of_figure_2(),
        "50 gaps of two plates, one after the other": path_of_held_states(),
    }
    arrays = list(kept_arrays((1, 2, 3, 4, 6)))
    draw(points)
    (HERE / "ladder.md").write_text(
        "\n".join(table(points, extra, arrays)) + "\n", encoding="utf-8"
    )


if __name__ == "__main__":
    main()
