"""Datafiles for Surface Evolver: their structure, and what Evolver itself makes of them."""

import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from sesame_cad.errors import InputError
from sesame_cad.files.evolver import evolver_datafile
from solver.compact import solve_loop
from solver.reading import Reading
from solver.scene import LoopScene

EXAMPLE = str(Path(__file__).parents[2] / "examples" / "large-array.toml")
LOOP = ["--strain", "0.3", "--beta", "0.0145", "--poisson", "0.3"]
SCENE = LoopScene(0.3, 0.0145, 0.3)
EVOLVER = next(filter(None, map(shutil.which, ("evolver-nox-d", "evolver-nox", "evolver"))), None)

with_evolver = pytest.mark.skipif(EVOLVER is None, reason="Surface Evolver is not installed")


def sections(text):
    """Words of the lines below each of vertices, edges and faces."""
    found = {}
    for name, end in (("vertices", "edges"), ("edges", "faces"), ("faces", "read")):
        body = re.search(rf"^{name}\n(.*?)^{end}$", text, re.MULTILINE | re.DOTALL)[1]
        found[name] = [line.split() for line in body.splitlines() if line]
    return found


def points_of(parts):
    return np.array([[float(x) for x in words[1:4]] for words in parts["vertices"]])


def after(words, key, count=1):
    """Words behind a keyword."""
    place = words.index(key)
    return words[place + 1 : place + 1 + count]


def wire_edges(parts):
    return [words for words in parts["edges"] if "sqcurve_string_mark" in words]


def in_evolver(text, folder, commands="solve"):
    """Type commands at Evolver's prompt; gives what is printed, and the numbers by their name."""
    file = folder / "loop.fe"
    file.write_text(text, encoding="ascii")
    run = subprocess.run(
        [EVOLVER, str(file)],
        input=f"{commands}\nquit\nquit\n",
        capture_output=True,
        text=True,
        timeout=30,
        check=False,
    )
    printed = run.stdout[run.stdout.rindex(commands.splitlines()[-1]) :]
    assert "ERROR" not in run.stdout + run.stderr
    return printed, {
        k: float(v) for k, v in re.findall(r"^(\w+) (-?\d\S*)$", printed, re.MULTILINE)
    }


@pytest.mark.parametrize("times", [1, 2, 3])
def test_counts_are_those_of_the_refined_fan(times):
    parts = sections(evolver_datafile(SCENE, times))
    ring, faces = 20 * 2**times, 20 * 4**times
    edges = (3 * faces + ring) // 2
    assert len(parts["faces"]) == faces
    assert len(parts["edges"]) == edges
    assert len(parts["vertices"]) == 1 + edges - faces
    assert len(wire_edges(parts)) == ring
    assert sum("bend" in words for words in parts["vertices"]) == ring
    assert all(int(words[0]) == 1 + k for part in parts.values() for k, words in enumerate(part))


def test_the_wire_is_the_circle():
    parts = sections(evolver_datafile(SCENE, 2))
    points = points_of(parts)
    on_wire = {int(n) for words in wire_edges(parts) for n in words[1:3]}
    assert on_wire == {int(words[0]) for words in parts["vertices"] if "on_wire" in words}
    radius = np.hypot(*points[[n - 1 for n in on_wire], :2].T)
    np.testing.assert_allclose(radius, 1, rtol=1e-14)
    perimeter = sum(float(after(words, "hooke_size")[0]) for words in wire_edges(parts))
    assert perimeter == pytest.approx(2 * 80 * np.sin(np.pi / 80), rel=1e-12)


def test_faces_are_closed_and_have_the_unstretched_sides():
    parts = sections(evolver_datafile(SCENE, 2))
    flat = points_of(parts)[:, :2]
    for words in parts["faces"]:
        ring = []
        for number in map(int, words[1:4]):
            ends = [int(n) - 1 for n in parts["edges"][abs(number) - 1][1:3]]
            ring.append(ends if number > 0 else ends[::-1])
        assert [ends[1] for ends in ring] == [ends[0] for ends in (*ring[1:], ring[0])]
        corner, one, other = flat[[ends[0] for ends in ring]]
        u, v = (one - corner) / 1.3, (other - corner) / 1.3
        assert u[0] * v[1] > u[1] * v[0]
        written = [float(x) for x in after(words, "form_factors")[0].strip("{}").split(",")]
        np.testing.assert_allclose(written, [u @ u, u @ v, v @ v], rtol=1e-12, atol=1e-15)


def test_pins_are_as_many_as_rigid_motions_and_hold_each_of_them():
    parts = sections(evolver_datafile(SCENE, 2))
    normals = {"1": (0, 0, 1), "2": (1, 0, 0), "3": (0, 1, 0)}
    rows = []
    for words, point in zip(parts["vertices"], points_of(parts), strict=True):
        if "constraint" in words:
            for number in words[words.index("constraint") + 1 :]:
                if number not in normals:
                    break
                rows.append([*normals[number], *np.cross(point, normals[number])])
                assert point @ normals[number] == 0
    assert len(rows) == 6
    assert np.linalg.svd(rows, compute_uv=False)[-1] > 0.1


def test_the_published_reading_is_another_modulus_and_poisson_ratio():
    nu = 0.45
    text = evolver_datafile(LoopScene(0.3, 0.06, nu, Reading.PUBLISHED), 1)
    p = float(after(sections(text)["faces"][0], "poisson_ratio")[0])
    modulus = float(re.search(r"^quantity fabric energy modulus (\S+)", text, re.MULTILINE)[1])
    a = modulus / (2 * (1 + p))
    assert (a, a * p / (1 - p)) == pytest.approx((1 / (1 + nu), nu / ((1 + nu) * (1 - 2 * nu))))


def test_the_start_is_a_saddle_of_the_height_asked_for():
    z = points_of(sections(evolver_datafile(SCENE, 2, 0.2)))[:, 2]
    assert (z.max(), z.min()) == pytest.approx((0.2, -0.2))
    assert not points_of(sections(evolver_datafile(SCENE, 2, 0)))[:, 2].any()


def test_the_text_is_plain_and_always_the_same():
    text = evolver_datafile(SCENE, 1)
    assert text.isascii()
    assert "-0.0 " not in evolver_datafile(SCENE, 1, 0)
    assert text == evolver_datafile(SCENE, 1)
    numbers = (np.float64(0.3), np.float64(0.0145), np.float64(0.3))
    assert text == evolver_datafile(LoopScene(*numbers, axial_stiffness=1000), 1)


@pytest.mark.parametrize(
    ("scene", "refinements", "height", "named"),
    [
        (SCENE, 0, 0.05, "refinements = 0"),
        (SCENE, 6, 0.05, "refinements = 6"),
        (SCENE, 2, -0.1, "start_height = -0.1"),
        (SCENE, 2, float("nan"), "start_height = nan"),
        (LoopScene(0.3, 0.0145, 0.3, modulus_ratio=1.1), 2, 0.05, "equally stiff"),
        (LoopScene(0.3, 0.0145, 0.3, natural_curvature=1), 2, 0.05, "straight by nature"),
        (LoopScene(0.3, 0.0145, 0.3, twist_ratio=0.75), 2, 0.05, "without twist"),
    ],
)
def test_what_the_datafile_cannot_say_is_refused(scene, refinements, height, named):
    with pytest.raises(InputError, match=re.escape(named)):
        evolver_datafile(scene, refinements, height)


@with_evolver
@pytest.mark.parametrize(
    ("scene", "height", "energy"),
    [
        # Surface Evolver 2.70 with independently written files of the same mesh (k = 2)
        (SCENE, 0.13051996, 0.3129675523362),
        (LoopScene(0.3, 0.06, 0.45, Reading.PUBLISHED), 0.15557937, 1.576405934177),
        (LoopScene(0.1, 0.005, 0.3), 0.089847899, 0.06073183201579),
        (LoopScene(0.3, 0.06, 0.3), 0.0, 0.6922620092721),
    ],
    ids=["plane-stress", "published", "small strain", "flat"],
)
def test_evolver_finds_the_known_shape(scene, height, energy, tmp_path):
    printed, found = in_evolver(evolver_datafile(scene, 2), tmp_path)
    assert re.search(r"^converged after \d+ steps$", printed, re.MULTILINE)
    assert found["height_over_perimeter"] == pytest.approx(height, abs=3e-7)
    assert found["energy"] == pytest.approx(energy, rel=1e-10)
    parts = [found[f"energy_{name}"] for name in ("fabric", "wire_bending", "wire_stretch")]
    assert sum(parts) == pytest.approx(energy, rel=1e-8)


@with_evolver
def test_evolver_leaves_the_flat_start(tmp_path):
    printed, found = in_evolver(evolver_datafile(SCENE, 2, 0), tmp_path)
    assert "\nconverged" in printed
    assert found["energy"] == pytest.approx(0.3129675523362, rel=1e-10)


@with_evolver
def test_fabric_that_resists_bending(tmp_path):
    """Other elements than ours, with the same limit."""
    scene = LoopScene(0.3, 0.0145, 0.3, alpha=0.1)
    coarse, fine = (in_evolver(evolver_datafile(scene, k), tmp_path)[1]["energy"] for k in (2, 3))
    assert fine + (fine - coarse) / 3 == pytest.approx(solve_loop(scene).energy, rel=2e-4)
    assert coarse > in_evolver(evolver_datafile(SCENE, 2), tmp_path)[1]["energy"] + 5e-5


def test_bending_of_the_fabric_is_that_of_inner_vertices():
    text = evolver_datafile(LoopScene(0.3, 0.0145, 0.3, alpha=0.1), 2)
    vertices = sections(text)["vertices"]
    assert "parameter fabric_stiffness = 0.1" in text
    assert all(("fabric_bend" in words) != ("on_wire" in words) for words in vertices)
    assert "fabric_bend" not in evolver_datafile(SCENE, 2)


@with_evolver
def test_another_wire_at_the_prompt(tmp_path):
    text = evolver_datafile(LoopScene(0.3, 0.06, 0.3, axial_stiffness=100), 2)
    commands = "solve\nwire_bending := 0.0145\nwire_stiffness := 1000\nsolve"
    _, found = in_evolver(text, tmp_path, commands)
    assert found["energy"] == pytest.approx(0.3129675523362, rel=1e-10)


@with_evolver
def test_evolver_says_when_it_did_not_converge(tmp_path):
    text = evolver_datafile(LoopScene(0.3, 1e-4, 0.3), 1).replace(
        "LARGEST_STEPS := 300", "LARGEST_STEPS := 3"
    )
    printed, _ = in_evolver(text, tmp_path)
    assert "NOT converged after" in printed
    assert "\nconverged" not in printed


@pytest.mark.parametrize(("state", "larger"), [("cold", 1), ("hot", 75 / 28)])
def test_a_specification_gives_the_state_of_its_wire(
    state, larger, run_command, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    code, out, _ = run_command(["export-evolver", EXAMPLE, "--state", state])
    assert code == 0
    assert out.startswith(f"wrote large-array-{state}.fe;")
    (file,) = tmp_path.iterdir()
    stiffness = [
        float(re.search(rf"^parameter {name} = (\S+)", file.read_text(), re.MULTILINE)[1])
        for name in ("wire_bending", "wire_stiffness")
    ]
    assert stiffness == pytest.approx([0.01454 * larger, 1163.4 * larger], rel=1e-3)


def test_cold_is_the_default(run_command, tmp_path):
    for name, more in (("one.fe", []), ("other.fe", ["--state", "cold"])):
        run_command(["export-evolver", EXAMPLE, *more, "-o", str(tmp_path / name)])
    one, other = (tmp_path / name for name in ("one.fe", "other.fe"))
    assert one.read_bytes() == other.read_bytes()


def test_options_alone_give_the_scene(run_command, tmp_path):
    target = tmp_path / "it.fe"
    more = ["--reading", "published", "--axial-stiffness", "50", "--refinements", "1"]
    code, _, err = run_command(["export-evolver", *LOOP, *more, "-o", str(target)])
    assert code == 0, err
    scene = LoopScene(0.3, 0.0145, 0.3, Reading.PUBLISHED, 50)
    assert target.read_text() == evolver_datafile(scene, 1)


def test_a_file_that_exists_is_left_as_it_is(faults_of_command, tmp_path):
    target = tmp_path / "mine.fe"
    target.write_text("mine")
    (fault,) = faults_of_command(["export-evolver", *LOOP, "-o", str(target)])
    assert "mine.fe exists already" in fault
    assert target.read_text() == "mine"
    assert list(tmp_path.iterdir()) == [target]


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        ([], ["--strain: missing", "--beta: missing", "--poisson: missing"]),
        (LOOP[:4], ["--poisson: missing"]),
        ([*LOOP, "--state", "hot"], ["--state: needs SPEC"]),
        ([EXAMPLE, *LOOP[:4]], ["--strain: SPEC says", "--beta: SPEC says"]),
        ([EXAMPLE, "--reading", "published"], ["--reading: SPEC says"]),
        ([*LOOP, "--poisson", "0.7"], ["poisson = 0.7"]),
        ([*LOOP, "--beta", "nan"], ["beta = nan"]),
        ([*LOOP, "--refinements", "9"], ["refinements = 9"]),
        (["none.toml"], ["none.toml: cannot be read"]),
        ([*LOOP, "-o", "none/loop.fe"], ["none is no directory"]),
    ],
)
def test_bad_input_is_one_line_per_fault(
    arguments, named, faults_of_command, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    faults = faults_of_command(["export-evolver", *arguments])
    assert len(faults) == len(named)
    assert all(word in fault for word, fault in zip(named, faults, strict=True))
    assert list(tmp_path.iterdir()) == []


def test_a_full_disk_leaves_nothing(run_command, tmp_path, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device", "loop.fe")

    monkeypatch.setattr(Path, "write_bytes", full)
    code, _, err = run_command(["export-evolver", *LOOP, "-o", str(tmp_path / "it.fe")])
    assert code == 1
    assert err == "error: loop.fe: No space left on device\n"
    assert list(tmp_path.iterdir()) == []
