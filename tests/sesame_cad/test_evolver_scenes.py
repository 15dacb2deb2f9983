"""Datafiles for Surface Evolver of ellipses, arrays and mixed loops: what Evolver makes of them."""

import re
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from sesame_cad.errors import InputError
from sesame_cad.evolver_scene import specified_scene
from sesame_cad.files.evolver import evolver_datafile
from sesame_cad.files.evolver_fabric import inner_vertices
from sesame_cad.files.evolver_scene import drawn
from sesame_cad.files.evolver_wires import EvolverWires
from sesame_cad.specification import specification_from
from solver.compact import solve_loop
from solver.mesh.curve import Through, circle, line
from solver.mesh.rod_energy import WireStiffness
from solver.mesh.scene import Contact
from solver.mesh.sheet import Joint, SheetScene, SheetWire
from solver.mesh.solve_sheet import solve_sheet
from solver.mesh.star_bending import stars
from solver.scene import LoopScene

EXAMPLES = Path(__file__).parents[2] / "examples"
EVOLVER = next(filter(None, map(shutil.which, ("evolver-nox-d", "evolver-nox", "evolver"))), None)
with_evolver = pytest.mark.skipif(EVOLVER is None, reason="Surface Evolver is not installed")

LOOP = {"rows": 1, "columns": 1, "loop_diameter_mm": 50}
ELLIPSE = {**LOOP, "axis_ratio": 1.5}
KEPT = {**LOOP, "rows": 2, "columns": 2, "between": "kept"}
CUT = {**KEPT, "between": "cut", "shape": "coupled"}
ROW = {"kind": "row", "diameters_mm": [45, 50, 40]}
"""The middle loop touches both others, which do not touch each other."""

SCENE = LoopScene(0.3, 0.01, 0.3)
ROUND = ((-1, 0), (0, -1), (1, 0), (0, 1))
WIRES = (WireStiffness(0.01, 900.0), WireStiffness(0.03, 2000.0), WireStiffness(0.015, 1100.0))
TERMS = {
    "fabric": "fabric stretch",
    "wire_bending": "wire bending",
    "wire_stretch": "wire stretch",
    "levelling": "levelling",
}


def spec_of(layout, **sections):
    wire = {"diameter_mm": 0.5}
    read = {"fabric": {"prestrain": 0.3}, "wire": wire, "layout": layout, **sections}
    return specification_from(read, "it", "test")


def scene_of(layout):
    return specified_scene(spec_of(layout), "cold")


def mixed():
    """The row with a wire of its own for each loop."""
    row = scene_of(ROW)
    own = zip(row.wires, WIRES, strict=True)
    return replace(row, wires=tuple(replace(wire, stiffness=one) for wire, one in own))


def bare():
    """Two loops that touch, one without fabric."""
    wires = (
        SheetWire(circle((-1, 0), 1), WIRES[0]),
        SheetWire(circle((1, 0), 1), WIRES[1], spanned=False),
    )
    return SheetScene(SCENE, wires, (Joint((0, 1), (0, 0)),))


SCENES = {
    "ellipse": lambda: scene_of(ELLIPSE),
    "ellipse of options": lambda: LoopScene(0.3, 0.0145, 0.3, axis_ratio=2),
    "kept": lambda: scene_of(KEPT),
    "cut": lambda: scene_of(CUT),
    "row": lambda: scene_of(ROW),
    "row of different wires": mixed,
    "a loop without fabric": bare,
}


@pytest.fixture(params=SCENES)
def scene(request):
    return SCENES[request.param]()


def in_evolver(text, folder, commands):
    """Type commands at Evolver's prompt; gives what is printed, and the numbers by their name."""
    file = folder / "it.fe"
    file.write_text(text, encoding="ascii")
    run = subprocess.run(
        [EVOLVER, str(file)],
        input=f"{commands}\nquit\nquit\n",
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert "ERROR" not in run.stdout + run.stderr
    printed = run.stdout[run.stdout.rindex(commands) :]
    return printed, {
        k: float(v) for k, v in re.findall(r"^(\w+) (-?\d\S*)$", printed, re.MULTILINE)
    }


def numbers_after(key, text):
    """All that stand behind a keyword, each once, in their order."""
    return sorted({float(one) for one in re.findall(rf"\b{key} ([\d.]+)", text)})


def bending_to_fourth_order(wires, positions):
    """Evolver's 4 β u (1 + u/6)/s, u = 1 − cos φ, on the solver's elements."""
    corners = positions[wires.vertices]
    one, other = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 1]
    lengths = np.linalg.norm(one, axis=1), np.linalg.norm(other, axis=1)
    u = 1 - np.sum(one * other, axis=1) / (lengths[0] * lengths[1])
    return float(np.sum(4 * wires.beta * u * (1 + u / 6) / sum(lengths)))


@with_evolver
def test_evolver_has_the_solvers_energies_at_the_same_positions(scene, tmp_path):
    """Its bending is the solver's but for φ⁴/90, here less than 1e-8 of it."""
    report = evolver_datafile(scene, 4).replace("%.10g", "%.15g").replace("%.13g", "%.15g")
    found = in_evolver(report, tmp_path, "report")[1]
    of = drawn(scene, 4, 0.05)
    energy = of.problem.energy(4)
    own = energy.terms(of.positions)
    own.pop("bonds", None)
    if "levelling" in own:
        # springs are as stiff in any unit of length, and so is what they weigh
        own["levelling"] /= scene.size**2
    ours = {name: own[TERMS[name]] for name in TERMS if TERMS[name] in own}
    assert sum(ours.values()) == pytest.approx(sum(own.values()), rel=1e-14)
    assert found["energy"] == pytest.approx(sum(own.values()), rel=1e-8)
    (wires,) = energy.families["wire bending"]
    ours["wire_bending"] = bending_to_fourth_order(wires, of.positions)
    assert {k.removeprefix("energy_") for k in found if k.startswith("energy_")} == set(ours)
    for name, value in ours.items():
        assert found[f"energy_{name}"] == pytest.approx(value, rel=1e-11), name


@with_evolver
def test_an_ellipse_comes_to_the_solvers_minimum(tmp_path):
    scene = scene_of(ELLIPSE)
    printed, found = in_evolver(evolver_datafile(scene, 2), tmp_path, "solve")
    assert "\nconverged after" in printed
    own = solve_sheet(scene, refinement=2)
    assert found["energy"] == pytest.approx(own.energy, rel=3e-6)
    # extent over the mesh's vertices here, of the curve through them there
    assert found["height_over_perimeter"] == pytest.approx(own.height / (2 * np.pi), rel=2e-3)


@with_evolver
def test_an_ellipse_of_options_converges_to_the_smooth_shape(tmp_path):
    scene = LoopScene(0.3, 0.0145, 0.3, axis_ratio=1.5)
    coarse, fine = (
        in_evolver(evolver_datafile(scene, k), tmp_path, "solve")[1]["energy"] for k in (2, 3)
    )
    assert fine + (fine - coarse) / 3 == pytest.approx(solve_loop(scene).energy, rel=2e-4)


@with_evolver
def test_a_row_comes_to_the_solvers_minimum_without_bonds(tmp_path):
    scene = mixed()
    printed, found = in_evolver(evolver_datafile(scene, 1), tmp_path, "solve")
    assert "\nconverged after" in printed
    loose = tuple(replace(joint, contact=Contact.POINT) for joint in scene.joints)
    own = solve_sheet(replace(scene, joints=loose), refinement=1)
    assert found["energy"] == pytest.approx(own.energy, rel=5e-5)


def test_wires_that_touch_bend_by_themselves():
    mesh = drawn(scene_of(KEPT), 1, 0.05).mesh
    said = EvolverWires(mesh, WIRES[:1] * 4)
    assert sorted(said.groups) == [0, 0, 1, 1]
    at = [set(wire.vertices.tolist()) for wire in mesh.wires]
    for one in range(4):
        for other in range(one):
            assert said.groups[one] != said.groups[other] or not at[one] & at[other]
    for vertex, words in said.at_vertices.items():
        bits = {said.groups[k] for k in range(4) if vertex in at[k]}
        assert {int(n) for n in re.findall(r"bend_(\d)\b", words)} == bits
    for wire, group in zip(mesh.wires, said.groups, strict=True):
        for edge in wire.edges.tolist():
            assert said.at_edges[frozenset(edge)].endswith(f"sqcurve_string_mark {1 << group}")


def test_different_wires_are_multiples_of_the_first():
    text = evolver_datafile(mixed(), 1)
    assert "parameter wire_bending = 0.01 " in text
    assert "parameter wire_stiffness = 900.0 " in text
    bends = set(re.findall(r"bend_share_(\d) ([\d.]+)", text))
    assert bends == {("0", "1.0"), ("1", "3.0"), ("0", "1.5")}
    assert numbers_after("stretch_share", text) == pytest.approx([1.0, 1100 / 900, 2000 / 900])
    assert "_share" not in evolver_datafile(scene_of(ROW), 1)


def test_circuits_have_their_own_wires():
    circuits = [
        {"name": "A", "cells": [[1, 1]]},
        {"name": "B", "cells": [[1, 2]], "wire_diameter_mm": 0.4},
    ]
    layout = {**LOOP, "columns": 2}
    spec = spec_of(layout, wiring={"circuits": circuits})
    text = evolver_datafile(specified_scene(spec, "cold"), 1)
    assert numbers_after("bend_share_1", text) == pytest.approx([0.8**4])
    assert numbers_after("stretch_share", text) == pytest.approx([0.8**2, 1])


@pytest.mark.parametrize("name", SCENES)
def test_pins_hold_rigid_motions_and_no_more(name):
    of = drawn(SCENES[name](), 1, 0.05)
    levelled = of.problem.levelling > 0
    assert len(of.pins) == (3 if levelled else 6)
    rows = [
        [*np.eye(3)[pin.axis], *np.cross(of.positions[pin.vertex], np.eye(3)[pin.axis])]
        for pin in of.pins
    ]
    assert np.linalg.svd(rows, compute_uv=False)[-1] > 0.1
    assert all(of.positions[pin.vertex, pin.axis] == pin.value for pin in of.pins)


def test_fabric_bends_where_there_is_fabric_all_round(scene):
    mesh = drawn(scene, 1, 0.05).mesh
    assert inner_vertices(mesh) == {int(k) for star in stars(mesh) for k in star[:, 0]}


def test_the_perimeter_of_an_ellipse_is_that_of_its_circle():
    text = evolver_datafile(LoopScene(0.3, 0.0145, 0.3, axis_ratio=2), 3)
    perimeter = sum(float(one) for one in re.findall(r"hooke_size ([\d.]+)", text))
    assert perimeter == pytest.approx(2 * np.pi, rel=1e-3)


def test_layouts_that_differ_have_files_that_differ():
    texts = {evolver_datafile(scene_of(one), 1) for one in (LOOP, ELLIPSE, KEPT, CUT, ROW)}
    assert len(texts) == 5
    kept, cut = (evolver_datafile(scene_of(one), 1).count("tension 0") for one in (KEPT, CUT))
    assert kept > cut == 4 * 80


def test_without_a_predicted_shape_the_scene_is_the_same():
    assert scene_of({**KEPT, "shape": "none"}) == scene_of(KEPT)
    assert scene_of({**LOOP, "shape": "none"}) == scene_of(LOOP)


def test_only_scenes_with_contacts_speak_of_them():
    for one in (LOOP, ELLIPSE, KEPT, ROW):
        text = evolver_datafile(scene_of(one), 1)
        assert ("has no bond" in text) == (one in (KEPT, ROW))


@pytest.mark.parametrize(
    ("scene", "refinements", "named"),
    [
        (lambda: scene_of(KEPT), 5, "triangles: Surface Evolver's datafile is written for 50000"),
        (lambda: replace(bare(), wires=(bare().wires[0],) * 2), 1, "curves meet"),
        (lambda: SheetScene(SCENE, (SheetWire(Through(ROUND, True), WIRES[0]),)), 1, "free curve"),
        (lambda: SheetScene(SCENE, (SheetWire(line((0, 0), (2, 0)), WIRES[0]),)), 1, "two ends"),
        (lambda: bare().twisted(0.7), 1, "without twist"),
        (lambda: replace(bare(), loop=replace(SCENE, alpha=0.1)), 1, "alpha = 0.1: "),
    ],
)
def test_what_a_datafile_cannot_say_is_refused(scene, refinements, named):
    with pytest.raises(InputError, match=named) as refused:
        evolver_datafile(scene(), refinements)
    assert all(len(fault.splitlines()) == 1 for fault in refused.value.faults)


def test_sleeves_are_refused_in_a_line(faults_of_command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (fault,) = faults_of_command(["export-evolver", str(EXAMPLES / "beam-sleeves.toml")])
    assert 'layout.kind = "sleeve"' in fault
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("example", "said"),
    [("hexagonal", "may turn about it"), ("large-array", "one loop stands for all 16")],
)
def test_the_command_says_what_the_file_leaves_out(example, said, run_command, tmp_path):
    target = tmp_path / "it.fe"
    code, out, _ = run_command(
        ["export-evolver", str(EXAMPLES / f"{example}.toml"), "-o", str(target)]
    )
    assert code == 0
    assert said in out
    assert "R = 25 mm" in out
    again = ["export-evolver", str(EXAMPLES / f"{example}.toml"), "-q"]
    assert run_command([*again, "-o", str(tmp_path / "other.fe")]) == (0, "", "")


def test_an_ellipse_of_options(run_command, tmp_path):
    target = tmp_path / "it.fe"
    arguments = ["--strain", "0.3", "--beta", "0.0145", "--poisson", "0.3", "--axis-ratio", "2"]
    assert run_command(["export-evolver", *arguments, "-o", str(target)])[0] == 0
    assert target.read_text() == evolver_datafile(LoopScene(0.3, 0.0145, 0.3, axis_ratio=2), 2)


@pytest.mark.parametrize("name", ["ellipse", "ellipse of options"])
def test_an_ellipse_starts_as_the_saddle_between_its_axes(name):
    """The saddle along its axes is a stationary point, but no minimum."""
    x, y, z = drawn(SCENES[name](), 2, 0.05).positions.T
    top = np.argmax(z)
    assert x[top] * y[top] > 0.3
    assert z.max() == pytest.approx(-z.min(), rel=1e-6)
    assert np.abs(z[np.abs(x * y) < 1e-9]).max() < 1e-9
