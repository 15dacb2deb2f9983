"""What the ladder answers in the far corners; run with ``python -m benchmarks.extremes``.

It writes ``docs/extremes.md``: each corner ends in a converged minimum, or in a refusal that names
the limit.
"""

from __future__ import annotations

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from pathlib import Path
from time import perf_counter

from solver.errors import NotConvergedError, SceneError
from solver.ladder.choose import solve_scene
from solver.ladder.fidelity import Fidelity
from solver.materials import LoopMaterials
from solver.reading import Reading
from solver.scene import LoopScene
from solver.threshold import critical_beta

OUT = Path(__file__).parents[1] / "docs" / "extremes.md"
BASE = {"strain": 0.3, "beta": 0.0145, "poisson": 0.3}


def physical(diameter_m, wire_m, fabric_kpa=700.0, wire_gpa=28.0):
    """Scene of a loop in SI units on Table I's fabric."""
    materials = LoopMaterials(fabric_kpa * 1e3, 0.27e-3, wire_gpa * 1e9, wire_m, diameter_m / 2)
    return {
        **BASE,
        "beta": materials.beta,
        "axial_stiffness": materials.axial_stiffness,
    }


def corners():
    """Names and scenes."""
    for beta in (1e-6, 1e-4, 1e-3, 1e-2, 1.0, 1e6):
        yield f"β = {beta:g}", {**BASE, "beta": beta}
    for strain in (0.0, 1e-6, 1.0, 2.0):
        yield f"ε = {strain:g}", {**BASE, "strain": strain}
    for poisson in (-0.9, 0.0, 0.4999):
        for reading in Reading:
            yield f"ν = {poisson:g}, {reading}", {**BASE, "poisson": poisson, "reading": reading}
    critical = critical_beta(0.3, 0.3, Reading.PLANE_STRESS)
    for off in (-1e-6, 0.0, 1e-6):
        yield f"β = β_c (1 {off:+g})", {**BASE, "beta": critical * (1 + off)}
    for stiffness in (1e-2, 1.0, 1e6, 1e9):
        yield f"axial stiffness {stiffness:g}", {**BASE, "axial_stiffness": stiffness}
    for ratio in (1.0, 1.5, 2.0, 3.0, 10.0):
        yield f"axis ratio {ratio:g}", {**BASE, "beta": 0.025, "axis_ratio": ratio}
    for ratio in (0.1, 1.1, 10.0, 1e6):
        yield f"modulus ratio {ratio:g}", {**BASE, "modulus_ratio": ratio}
    for alpha in (2.4e-5, 1e-3, 0.1, 1.0, 2.0):
        yield f"α = {alpha:g}", {**BASE, "alpha": alpha}
    for alpha in (1e-6, 1e-4, 1e-2):
        yield f"α = {alpha:g}, β = 0.002", {**BASE, "beta": 0.002, "alpha": alpha}
    for diameter, wire in ((1e-4, 1e-6), (1e-4, 1e-5), (10.0, 1e-2), (10.0, 1e-3), (0.05, 1e-2)):
        yield f"loop {diameter:g} m, wire {wire:g} m", physical(diameter, wire)
    for fabric_kpa, wire_gpa in ((1e-3, 28.0), (1e9, 28.0), (700.0, 1e-6), (700.0, 1e6)):
        name = f"fabric {fabric_kpa:g} kPa, wire {wire_gpa:g} GPa"
        yield name, physical(0.05, 5e-4, fabric_kpa, wire_gpa)


def outcome(numbers):
    """Say what came out, and in how many seconds."""
    start = perf_counter()
    try:
        answer = solve_scene(LoopScene(**numbers), fidelity=Fidelity.AUTO, tolerance=1e-2)
        height = answer.height_over_perimeter
        text = f"{answer.rung}: {'flat' if not answer.buckled else f'h/(π d_0) = {height:.5f}'}"
    except (SceneError, NotConvergedError) as error:
        text = f"refused: {error}"
    return text.replace("|", "/"), perf_counter() - start


def main():
    lines = [
        "# Extremes",
        "",
        "What `solve --tolerance 0.01` answers in far corners; everything not named is ε = 0.3,",
        "β = 0.0145, ν = 0.3 (β = 0.025 for ellipses). Made by `python -m benchmarks.extremes`.",
        "",
        "| corner | outcome | seconds |",
        "|---|---|---|",
    ]
    for name, numbers in corners():
        text, seconds = outcome(numbers)
        lines.append(f"| {name} | {text} | {seconds:.2g} |")
        print(lines[-1])
    OUT.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
