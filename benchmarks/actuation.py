"""Cost and accuracy of a path from cold to hot and back, of loads on the cell, and of the heat.

Run with ``python -m benchmarks.actuation``, one thread; it writes ``benchmarks/actuation.md``.
"""

from __future__ import annotations

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("OMP_NUM_THREADS", "1")

import platform
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from time import perf_counter, process_time

import numpy as np

from solver.actuation.cell_path import HeatedCell, cell_path, follow_cell
from solver.actuation.convection import natural_convection_W_m2K
from solver.actuation.duty import Duty, follow
from solver.actuation.lifting import stands_at
from solver.actuation.load_table import load_table
from solver.actuation.transformation import Transformation
from solver.actuation.wire import HeatedWire, Surroundings, at_rest
from solver.mesh.solve import solve_loop_mesh
from solver.scaling_law import scaling_height
from solver.scene import LoopScene

HERE = Path(__file__).parent
COLD = LoopScene(0.3, 0.01454, 0.3, axial_stiffness=1163.0)
CELLS = {
    "large array, ν = 0.3": HeatedCell(COLD, 75 / 28),
    "large array, ν = 0.45": HeatedCell(replace(COLD, poisson=0.45), 75 / 28),
    "flat when hot (four times stiffer), ν = 0.3": HeatedCell(COLD, 4.0),
}
STATES = 25
MESH_STATES = 5
FIRST = "--first"
WIRE = HeatedWire(3e-4, 6450.0, 80e-8, 100e-8, 28e9, 75e9, Transformation(60, 70, 40, 30))


def cpu(repeats, work):
    """Least CPU seconds of a few times, and the last result."""
    times = []
    for _ in range(repeats):
        start = process_time()
        result = work()
        times.append(process_time() - start)
    return min(times), result


def first_path():
    """CPU and wall seconds of the first path of a process, with the bases' tables."""
    cell = CELLS["large array, ν = 0.45"]
    begin, wall = process_time(), perf_counter()
    cell_path(cell, states=STATES)
    return process_time() - begin, perf_counter() - wall


def largest_error(found, exact):
    """Of the heights, relative to the largest."""
    found, exact = np.array(found), np.array(exact)
    return float(np.abs(found - exact).max() / exact.max())


def rungs(cell):
    """Every rung on the path of one cell: what, CPU seconds for 50 states, error of heights."""
    fractions = [float(one) for one in np.linspace(0, 1, STATES)]
    exact = [one.shape.height for one in follow_cell(cell, fractions, tolerance=1e-7)]
    scenes = [cell.scene(fraction) for fraction in fractions]
    seconds, ratios = cpu(
        20, lambda: [scaling_height(s.strain, s.beta, s.poisson, s.reading) for s in scenes]
    )
    heights = [2 * np.pi * float(ratio) for ratio in ratios]
    yield "scaling law", 2 * seconds, largest_error(heights, exact)
    for tolerance in (1e-3, 1e-4, 1e-6):
        seconds, path = cpu(3, lambda t=tolerance: cell_path(cell, states=STATES, tolerance=t))
        heights = [one.shape.height for one in path.heating]
        yield f"compact, {tolerance:.0e}", seconds, largest_error(heights, exact)
    few = slice(None, None, (STATES - 1) // (MESH_STATES - 1))
    for k in (2, 3):
        seconds, found = cpu(
            1, lambda k=k: [solve_loop_mesh(scene, refinement=k) for scene in scenes[few]]
        )
        heights = [one.height for one in found]
        share = 2 * STATES / MESH_STATES
        what = f"mesh, k = {k} ({MESH_STATES} states, times {share:g})"
        yield what, share * seconds, largest_error(heights, exact[few])


def loads(cell):
    """CPU seconds of a table of loads, and the largest error of its heights."""
    response = cell_path(cell).response
    seconds, table = cpu(1, lambda: load_table(cell, response))
    errors = []
    for fraction in (0.0, 0.25, 0.55):
        free = float(response.height(np.array([fraction]))[0])
        for share in (0.3, 0.9):
            load = share * table.largest_load(fraction)
            exact = stands_at(cell.scene(fraction), free, load).height
            errors.append(abs(table.height(fraction, load) / exact - 1))
    return seconds, max(errors)


def heat():
    """CPU seconds of ten cycles of heat, and the error of their balance."""
    around = Surroundings(25.0, natural_convection_W_m2K(3e-4, 65.0, 25.0))
    start = at_rest(WIRE, 25.0)
    intervals = Duty(0.6, 20.0, 40.0, 10).intervals
    seconds, history = cpu(3, lambda: follow(WIRE, around, start, intervals))
    course = history.course
    stored = WIRE.stored_J_m(course.temperature_C, course.fraction)
    lack = course.joule_J_m - course.loss_J_m - (stored - WIRE.stored_J_m(25.0, 0.0))
    return seconds, float(np.abs(lack).max() / course.joule_J_m[-1])


def table(first):
    """Markdown of everything measured."""
    yield "# Actuation, measured"
    yield ""
    yield "`python -m benchmarks.actuation`, one thread, CPU seconds; other work shared the cores."
    yield f"{platform.machine()}, Python {platform.python_version()}."
    yield ""
    yield f"{2 * STATES} states of one cell, cold to hot and back, β from 0.01454 (ε = 0.3):"
    yield ""
    yield "| cell | rung | CPU s | error of the heights / the largest |"
    yield "|---|---|---|---|"
    for name, cell in CELLS.items():
        for what, seconds, error in rungs(cell):
            yield f"| {name} | {what} | {seconds:.2g} | {error:.1e} |"
    yield ""
    yield "The first path of a process makes the tables of the bases too: large array, ν = 0.45,"
    yield f"compact, 1e-4: {first[0]:.2f} s CPU, {first[1]:.2f} s on the clock."
    yield ""
    yield "| also | CPU s | error |"
    yield "|---|---|---|"
    for name, cell in CELLS.items():
        seconds, error = loads(cell)
        yield f"| table of loads: {name} | {seconds:.2g} | {error:.1e} of the height under load |"
    seconds, error = heat()
    what = "ten cycles of heat, 101 times in each interval"
    yield f"| {what} | {seconds:.2g} | {error:.0e} of the heat |"


def main():
    command = [sys.executable, "-m", "benchmarks.actuation", FIRST]
    said = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    first = tuple(float(word) for word in said.split())
    (HERE / "actuation.md").write_text("\n".join(table(first)) + "\n", encoding="utf-8")


if __name__ == "__main__":
    if FIRST in sys.argv:
        print(*first_path())
    else:
        main()
