"""The page that shows a design: what it holds, and what a browser makes of it."""

import json
import re
import shutil
import tempfile
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

from patterns.records import Command
from patterns.violation import Violation
from sesame_cad.actuation.subject import heated_wire
from sesame_cad.files.dst import decode_dst
from sesame_cad.package import write_package
from sesame_cad.pipeline import design
from sesame_cad.report.cell_view import cell_view
from sesame_cad.report.embedding import embedded, read_embedded
from sesame_cad.report.fabric_look import fabric_look
from sesame_cad.report.heating import austenite_fraction
from sesame_cad.report.packing import packed_integers, packed_reals, unpacked
from sesame_cad.report.page import report_html
from sesame_cad.report.phase_diagram import phase_diagram
from sesame_cad.report.recovery import at_vertices
from sesame_cad.report.sheet_view import sheet_view
from sesame_cad.report.solved_path import solved_path
from sesame_cad.report.stitch_view import STITCH_DATA, stitch_view, viewed_records
from sesame_cad.report_checks import report_faults
from sesame_cad.specification import load_specification, specification_from
from sesame_cad.state import solve_state
from solver.mesh.fabric_law import StVenantKirchhoff
from solver.mesh.fields import strained_fields
from solver.mesh.triangle_energy import green_lagrange
from solver.reading import Reading
from solver.threshold import critical_beta, line_tension

EXAMPLES = Path(__file__).parents[2] / "examples"
CHROMIUM = shutil.which("chromium")
FLAGS = (
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
)


@pytest.fixture(scope="module")
def spec():
    return load_specification(EXAMPLES / "large-array.toml")


@pytest.fixture(scope="module")
def states(spec):
    moduli = {"cold": spec.wire.modulus_cold_GPa, "hot": spec.wire.modulus_hot_GPa}
    return tuple(solve_state(spec, name, modulus) for name, modulus in moduli.items())


@pytest.fixture(scope="module")
def view(spec, states):
    return cell_view(spec, *states)


@pytest.fixture(scope="module")
def stitched():
    """A design of two circuits without a shape, its package's folder, and what it holds."""
    layout = {"rows": 1, "columns": 4, "loop_diameter_mm": 30, "shape": "none"}
    circuits = [
        {"name": "left", "cells": [[1, 1], [1, 2]], "terminals": "left"},
        {"name": "right", "cells": [[1, 3], [1, 4]], "terminals": "right"},
    ]
    sections = {"wire": {"diameter_mm": 0.5}, "layout": layout, "output": {"pictures": False}}
    made = specification_from(sections | {"wiring": {"circuits": circuits}}, "array", "test")
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "array"
        data = write_package(made, target, lambda _: None)
        records = decode_dst((target / "stitch/array.dst").read_bytes()).records
        yield design(made), target, data, records


class Links(HTMLParser):
    """Everything to which a page leads, or that it would load."""

    def __init__(self):
        super().__init__()
        self.found = []

    def handle_starttag(self, tag, attrs):
        self.found += [value for key, value in attrs if key in {"href", "src", "srcset", "data"}]


def test_packed_numbers_come_back():
    values = np.random.default_rng(1).normal(size=(5, 7)) * 100
    packed = json.loads(json.dumps(packed_reals(values)))
    assert np.abs(unpacked(packed) - values).max() <= np.abs(values).max() / 65534 * 1.001
    whole = np.arange(-100, 100, dtype=np.int8).reshape(2, -1)
    assert np.array_equal(unpacked(packed_integers(whole)), whole)
    assert np.array_equal(unpacked(packed_reals(np.zeros(3))), np.zeros(3))


def look(spec, deformation, law):
    return fabric_look(spec, strained_fields(green_lagrange(deformation), law))


def test_the_fields_of_flat_fabric_are_known(spec):
    strain, poisson = 0.3, 0.45
    flat = (1 + strain) * np.eye(3)[None, :, :2]
    fields = look(spec, flat, StVenantKirchhoff(plane_stress(poisson)))
    assert fields.stretch_percent == pytest.approx(30)
    sheet_modulus_N_m = spec.fabric.modulus_kPa * spec.fabric.thickness_mm
    assert fields.tension_N_m == pytest.approx(
        sheet_modulus_N_m * line_tension(strain, poisson, Reading.PLANE_STRESS)
    )


def test_tension_is_the_force_that_does_the_work(spec):
    """A strip: what its energy gains by a little more length is its force times that."""
    law = StVenantKirchhoff(plane_stress(0.3))
    long, wide, step = 1.4, 1.1, 1e-6

    def energy(length):
        strain = np.array([[(length**2 - 1) / 2, (wide**2 - 1) / 2, 0.0]])
        return law.density(strain)[0]

    force = (energy(long + step) - energy(long - step)) / (2 * step)
    force *= spec.fabric.modulus_kPa * spec.fabric.thickness_mm
    stretched = np.array([[[long, 0], [0, wide], [0, 0]]])
    assert look(spec, stretched, law).tension_N_m == pytest.approx(force / wide, rel=1e-8)


def plane_stress(poisson):
    one = 1 / (1 - poisson**2)
    shear = 1 / (2 * (1 + poisson))
    return np.array([[one, poisson * one, 0], [poisson * one, one, 0], [0, 0, shear]])


def test_the_way_leads_through_the_shapes_of_the_design(view, states):
    stops = {state["stop"]: state for state in view["states"] if state["stop"]}
    assert list(stops) == ["flat", "cold", "hot"]
    for state in states:
        assert stops[state.name]["heightMm"] == state.height_mm
        assert stops[state.name]["pitchMm"] == state.pitch_mm
    assert stops["flat"]["heightMm"] == 0
    assert stops["flat"]["pitchMm"] == pytest.approx(50)
    heights = [state["heightMm"] for state in view["states"]]
    cold = heights.index(stops["cold"]["heightMm"])
    assert view["whole"]
    assert np.all(np.diff(heights[1 : cold + 1]) > 0)
    assert np.all(np.diff(heights[cold:]) < 0)
    for part in (heights[1 : cold + 1], heights[cold:]):
        steps = np.abs(np.diff(part))
        assert steps.max() < 1.2 * steps.min()


def test_the_way_from_cold_to_hot_is_that_of_heated_wire(spec, view):
    wire = heated_wire(spec)
    ends = view["heating"]
    assert (ends["startC"], ends["finishC"]) == wire.transformation.temperatures_C[:2]
    cold = [state["stop"] for state in view["states"]].index("cold")
    shares = [state["austenite"] for state in view["states"]]
    assert set(shares[:cold]) == {None}
    assert (shares[cold], shares[-1]) == (0, 1)
    for state, share in zip(view["states"][cold:], shares[cold:], strict=True):
        assert wire.modulus_Pa(share) == pytest.approx(1e9 * state["modulusGPa"])
    cold_GPa = spec.wire.modulus_cold_GPa
    alike = spec.wire.model_copy(update={"modulus_hot_GPa": cold_GPa})
    assert austenite_fraction(spec.model_copy(update={"wire": alike}), cold_GPa) is None


def test_straight_lines_between_neighbours_are_near_the_solved_shapes(spec, states):
    """Half-way between two solved states on the way, whose steps are those of a root."""
    path = solved_path(spec, *states)
    threshold = path.states[1].wire_modulus_GPa
    errors = []
    for one, other in zip(path.states[1:], path.states[2:], strict=False):
        roots = [np.sqrt(threshold - state.wire_modulus_GPa) for state in (one, other)]
        between = solve_state(spec, "cold", threshold - np.mean(roots) ** 2)
        mean = (one.height_mm + other.height_mm) / 2
        errors.append(abs(between.height_mm - mean) / states[0].height_mm)
    assert errors[0] < 0.015  # a wire that stretches a little buckles a little later
    assert max(errors[1:]) < 0.001


def test_points_and_wire_have_the_height_that_is_told(view):
    points = unpacked(view["points"])
    edge = points[:, -view["segments"] :]
    heights = np.ptp(edge[..., 2], axis=1)
    told = np.array([state["heightMm"] for state in view["states"]])
    assert np.abs(heights - told).max() < 0.01
    assert edge[:, 0, 1] == pytest.approx(0)  # the first lies on +x
    pitch = np.ptp(edge[..., 0], axis=1)
    assert np.abs(pitch - [state["pitchMm"] for state in view["states"]]).max() < 0.01


def test_the_way_of_an_array_that_is_flat_when_hot():
    sections = {
        "wire": {"diameter_mm": 0.5, "modulus_hot_GPa": 200},
        "layout": {"rows": 1, "columns": 2, "loop_diameter_mm": 50},
    }
    spec = specification_from(sections, "array", "test")
    cold, hot = (solve_state(spec, name, m) for name, m in (("cold", 28.0), ("hot", 200.0)))
    assert not hot.buckled
    path = solved_path(spec, cold, hot)
    assert path.whole
    assert path.states[-1].height_mm == 0
    assert path.states[path.cold].height_mm == cold.height_mm
    moduli = [state.wire_modulus_GPa for state in path.states[path.cold :]]
    assert np.all(np.diff(moduli) > 0)


def test_the_stretch_is_that_of_lines_drawn_on_the_fabric(view, states):
    """By differences of positions, in the middle of the loop, where no line is longer than along x
    or y.
    """
    stretch = unpacked(view["stretch"])
    assert stretch[0] == pytest.approx(30, abs=1e-3)
    cold, step = states[0], 1e-4
    ends = cold.equilibrium.shape.position(step, np.array([0, np.pi, np.pi / 2, -np.pi / 2]))
    lengths = [np.linalg.norm(ends[k] - ends[k + 1]) / (2 * step) for k in (0, 2)]
    index = [state["stop"] for state in view["states"]].index("cold")
    assert stretch[index, 0] == pytest.approx(130 * max(lengths) - 100, abs=0.01)


def test_coupled_shapes_are_three_meshes():
    sections = {
        "wire": {"diameter_mm": 0.5},
        "layout": {"rows": 1, "columns": 2, "loop_diameter_mm": 50, "shape": "coupled"},
        "model": {"refinement": 1},
    }
    spec = specification_from(sections, "pair", "test")
    cold, hot = design(spec).states
    view = sheet_view(spec, cold, hot)
    assert [state["stop"] for state in view["states"]] == ["flat", "cold", "hot"]
    assert not view["whole"]
    for state, told in zip(view["states"][1:], (cold, hot), strict=True):
        assert state["heightMm"] == told.height_mm
        points, wires = unpacked(state["points"]), [unpacked(wire) for wire in state["wires"]]
        edge = points[np.concatenate(wires)]
        assert np.ptp(edge[:, 2]) == pytest.approx(told.height_mm, rel=0.005)
        assert unpacked(state["triangles"]).max() == len(points) - 1
        assert len(unpacked(state["stretch"])) == len(points)
    slope = np.array([3.0, -2.0])
    mesh = cold.found.mesh
    linear = 7 + mesh.points[mesh.triangles].mean(axis=1) @ slope
    assert at_vertices(mesh, linear) == pytest.approx(7 + mesh.points @ slope, abs=1e-8)
    flat = view["states"][0]
    assert flat["pitchMm"] == pytest.approx(50, rel=1e-3)
    assert np.ptp(unpacked(flat["points"])[:, 2]) == 0
    assert unpacked(flat["stretch"]) == pytest.approx(30, abs=0.01)
    for curvature in flat["curvature"]:
        assert unpacked(curvature) == pytest.approx(1 / 25, rel=0.01)


def test_the_page_holds_the_records_of_the_dst_file(stitched):
    _, target, _, records = stitched
    data = read_embedded((target / "report.html").read_text(), STITCH_DATA)
    shown = viewed_records(data)
    assert np.array_equal(shown.xy, records.xy)
    assert np.array_equal(shown.command, records.command)
    stops = int(np.sum(records.command == Command.STOP))
    assert len(data["blocks"]) == stops + 1
    assert data["violations"] == []


def test_a_page_with_other_stitches_is_found(stitched):
    made, target, data, records = stitched
    assert list(report_faults((target / "report.html").read_bytes(), records)) == []
    moved = records.xy.copy()
    moved[5:] += (3, 0)
    other = replace(records, xy=moved)
    page = report_html(made, data, other).encode()
    assert list(report_faults(page, records)) == ["its stitches are not those of the DST file"]
    for content in (b"", b"\xff", embedded(STITCH_DATA, {"steps": 1}).encode()):
        (fault,) = report_faults(content, records)
        assert len(fault.splitlines()) == 1


def test_the_page_is_what_the_design_says(stitched):
    made, target, data, _ = stitched
    text = (target / "report.html").read_text()
    assert 'layout.shape is "none"' in text.replace("&quot;", '"')
    assert 'id="shape-data"' not in text
    for block in data["stitch"]["blocks"]:
        assert block["instruction"] in text
    for warning in data["electrics"]["warnings"]:
        assert warning in text
    assert data["electrics"]["warnings"]
    for circuit in data["circuits"]:
        assert f"{circuit['resistance_ohm_cold']:.2f} Ω" in text
    width = np.diff(np.array(made.pattern.outline.bounds_mm).reshape(2, 2), axis=0)[0]
    for size in width:
        assert f"{size:.1f} mm" in text
    assert data["files"]["report.html"]["bytes"] == len(text.encode())


def test_links_lead_to_files_beside_the_page_and_nowhere_else(stitched):
    _, target, data, _ = stitched
    links = Links()
    links.feed((target / "report.html").read_text())
    files = {link for link in links.found if not link.startswith("#")}
    assert files == {"design.json", *data["files"]} - {"report.html"}
    for link in files:
        assert (target / link).is_file()


def test_every_file_of_a_package_is_linked_and_explained(large_array):
    text = (large_array / "report.html").read_text()
    listed = dict(re.findall(r'<li><a href="([^"]+)">[^<]*</a> <span>([^<]*)</span>', text))
    on_disk = {file.relative_to(large_array).as_posix() for file in large_array.rglob("*.*")}
    assert set(listed) == on_disk - {"report.html"}
    assert all(listed.values())
    assert {Path(link).suffix for link in listed} >= {".stl", ".3mf", ".glb", ".vtu"}


def test_a_name_cannot_break_out_of_the_page(stitched):
    made, _, data, records = stitched
    evil = "</script><script>alert(1)</script><b>"
    broken = (Violation("net", evil, 1.0, 2.0),)
    text = report_html(made, data | {"name": evil}, records, broken)
    assert evil not in text
    assert "<b>&" not in text.split("<main>")[0]
    assert read_embedded(text, STITCH_DATA)["violations"][0]["text"].startswith(f"net: {evil}")


def test_broken_rules_are_told_and_placed(stitched):
    made, _, data, records = stitched
    broken = (Violation("hoop", "outside", 12.5, -3.0, block=1),)
    assert "design rules hold" in report_html(made, data, records)
    text = report_html(made, data, records, broken)
    assert "design rules hold" not in text
    assert "hoop: outside" in text
    (told,) = stitch_view(made, records, broken)["violations"]
    assert (told["xMm"], told["yMm"]) == (12.5, -3.0)


def test_the_same_design_gives_the_same_bytes(stitched):
    made, target, data, records = stitched
    files = {path: own for path, own in data["files"].items() if path != "report.html"}
    again = report_html(replace(made), data | {"files": files}, records)
    assert again.encode() == (target / "report.html").read_bytes()


def test_the_phase_diagram_has_the_threshold_above_what_buckles():
    found = phase_diagram(
        {
            "strain": 0.3,
            "poisson": 0.45,
            "reading": "plane-stress",
            "beta": 0.9 * critical_beta(0.3, 0.45, Reading.PLANE_STRESS),
            "beta_hot": 1.1 * critical_beta(0.3, 0.45, Reading.PLANE_STRESS),
        }
    )
    curve = re.search(r'class="threshold" d="M([^"]*)"', found)[1]
    points = np.array([pair.split(",") for pair in curve.split("L")], dtype=float)
    dots = re.findall(r'class="point (\w+)" cx="([\d.]+)" cy="([\d.]+)"', found)
    for name, x, y in dots:
        height = np.interp(float(x), points[:, 0], points[:, 1])
        assert (float(y) > height) == (name == "cold")  # y is down
    assert len(dots) == 2


@pytest.fixture(scope="module")
def browser():
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    if CHROMIUM is None:
        pytest.skip("no chromium is found")
    with playwright.sync_playwright() as driver:
        launched = driver.chromium.launch(executable_path=CHROMIUM, headless=True, args=list(FLAGS))
        yield launched
        launched.close()


@pytest.fixture
def opened(browser):
    """Open a page, and give it; it must not complain, nor ask for anything else."""
    pages = []
    faults = []

    def opening(path):
        page = browser.new_page()
        page.on("console", lambda m: faults.append(m.text) if m.type == "error" else None)
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.on("request", lambda r: asked.append(r.url))
        asked = []
        page.goto(path.as_uri())
        page.wait_for_selector("html.ready")
        assert asked == [path.as_uri()]
        pages.append(page)
        return page

    yield opening
    assert faults == []
    for page in pages:
        page.close()


def test_the_slider_ends_at_the_heights_of_the_design(opened, large_array):
    page = opened(large_array / "report.html")
    data = json.loads((large_array / "design.json").read_text())
    slider, height = page.locator("[name=place]"), page.locator("[data-say=height]")
    assert height.inner_text() == f"{data['cold']['height_mm']:.2f} mm"
    slider.focus()
    slider.press("End")
    assert height.inner_text() == f"{data['hot']['height_mm']:.2f} mm"
    assert page.locator("[data-say=pitch]").inner_text() == f"{data['hot']['pitch_mm']:.2f} mm"
    slider.press("Home")
    assert height.inner_text() == "0.00 mm"
    assert page.locator("[data-say=state]").inner_text() == "flat, as it is sewn"
    page.emulate_media(reduced_motion="reduce")
    page.get_by_role("button", name="Cold", exact=True).press("Enter")
    assert height.inner_text() == f"{data['cold']['height_mm']:.2f} mm"
    page.locator("#viewer canvas").focus()
    page.keyboard.press("ArrowLeft")
    assert page.evaluate("sesameReport.viewer.azimuth") == -54
    assert not page.locator("#viewer").evaluate("v => v.classList.contains('blind')")


def test_the_slider_has_the_temperatures_of_the_heated_wire(opened, large_array, spec):
    law = heated_wire(spec).transformation
    page = opened(large_array / "report.html")
    slider, told = page.locator("[name=place]"), page.locator("[data-say=temperature]")
    start, finish = law.temperatures_C[:2]
    assert told.inner_text() == f"up to {start:.1f} °C"
    slider.press("End")
    assert told.inner_text() == f"{finish:.1f} °C or more"
    fraction = page.evaluate("""() => {
      const viewer = sesameReport.viewer;
      viewer.place(viewer.stop('cold') + 2.5);
      return viewer.shapes.numbers(viewer.s).austenite;
    }""")
    assert 0.1 < fraction < 0.9
    assert told.inner_text() == f"{law.heated_to(fraction):.1f} °C"
    marks = page.locator(".degrees span")
    assert marks.all_inner_texts() == ["40 °C", "42.5 °C", "45 °C", "47.5 °C", "50 °C"]
    for k, mark in enumerate(marks.all()):
        share = float(mark.evaluate("m => parseFloat(m.style.left)")) / 100
        page.evaluate("s => sesameReport.viewer.place(s * sesameReport.viewer.slider.max)", share)
        if 0 < k < 4:
            assert told.inner_text() == f"{start + k / 4 * (finish - start):.1f} °C"


def test_something_is_drawn_in_space(opened, large_array):
    page = opened(large_array / "report.html")
    page.evaluate("sesameReport.viewer.rest()")
    pixels = page.evaluate(
        """() => {
          const viewer = sesameReport.viewer, gl = viewer.painter.gl;
          viewer.draw();
          const all = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
          gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA,
            gl.UNSIGNED_BYTE, all);
          return all.filter((v, i) => i % 4 === 3 && v > 0).length / (all.length / 4);
        }"""
    )
    assert 0.05 < pixels < 0.6


def test_the_player_ends_at_the_last_record(opened, stitched):
    _, target, data, records = stitched
    page = opened(target / "report.html")
    say = {
        name: page.locator(f"[data-say={name}]")
        for name in ("record", "stitch", "needle", "block", "instruction", "distance")
    }
    count = len(records.command)
    page.locator("#player canvas").focus()
    page.keyboard.press("Home")
    assert say["record"].inner_text() == f"record 0 of {count}: start"
    page.keyboard.press(".")
    assert say["record"].inner_text().startswith("record 1 of")
    # it waits at each stop, and says what is to be done there
    page.locator("[name=speed]").select_option("5000")
    for block in data["stitch"]["blocks"][1:]:
        page.keyboard.press("Space")
        page.locator("[data-do=play]", has_text="Play").wait_for()
        assert say["block"].inner_text().startswith("Stop before block")
        assert say["instruction"].inner_text() == block["instruction"]
    page.keyboard.press("Space")
    page.locator("[data-do=play]", has_text="Play").wait_for()
    x, y = records.xy[-1] / 10
    assert say["record"].inner_text() == f"record {count} of {count}: end"
    assert say["needle"].inner_text() == f"at {x:.1f}, {y:.1f} mm"
    stitches = data["stitch"]["stitches"]
    assert say["stitch"].inner_text() == f"stitch {stitches} of {stitches}"
    assert page.locator("[name=record]").input_value() == str(count)


def test_stitches_move_with_the_view_and_are_drawn_anew(opened, stitched):
    """Shifted at once, and the same when the view has settled."""
    _, target, _, _ = stitched
    page = opened(target / "report.html")
    shift_px = 24
    same = """async (shift) => {
      const { player } = sesameReport, { picture } = player, { canvas } = picture;
      const pixels = (left) => canvas.getContext('2d')
        .getImageData(left, 0, canvas.width - shift, canvas.height).data;
      const differing = (one, other) => one.filter((v, i) => Math.abs(v - other[i]) > 8).length;
      player.draw(true);
      const before = pixels(0);
      picture.pan(shift, 0);
      player.draw();
      const moving = [picture.stale, differing(before, pixels(shift))];
      picture.zoomBy(2);
      player.draw();
      const nearer = differing(before, pixels(shift));
      picture.zoomBy(0.5);
      player.draw();
      while (picture.stale) await new Promise((next) => setTimeout(next, 10));
      return [...moving, nearer, differing(before, pixels(shift))];
    }"""
    stale, moving, nearer, settled = page.evaluate(same, shift_px)
    assert (stale, moving) == (True, 0)
    # soft edges come out a little different in another place
    assert settled < 0.02 * nearer


def test_clicks_measure_between_needle_points(opened, stitched):
    _, target, _, records = stitched
    page = opened(target / "report.html")
    canvas = page.locator("#player canvas")
    sewn = np.flatnonzero(records.command == Command.STITCH)
    one, other = records.xy[sewn[3]] / 10, records.xy[sewn[-3]] / 10
    for x, y in (one, other):
        at = page.evaluate("([x, y]) => sesameReport.player.picture.onPage(x, y)", [x, y])
        canvas.click(position={"x": at[0], "y": at[1]})
    said = page.locator("[data-say=distance]").inner_text()
    told = float(said.split(" mm")[0])
    # another needle point may be as near to the pixel
    assert told == pytest.approx(np.hypot(*(other - one)), abs=1.0)
    page.keyboard.press("Escape")
    assert "Click two places" in page.locator("[data-say=distance]").inner_text()
