"""The worksheet, read by another library: pages, words, and the outline in its size."""

import io
import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from pypdf import PdfReader
from pypdf.generic import ContentStream

from patterns.records import plan_records
from sesame_cad.pictures.paper import MARGIN_MM, PAPERS_MM, printable, text_width_mm, wrapped
from sesame_cad.pictures.worksheet import worksheet_pdf
from sesame_cad.pipeline import design
from sesame_cad.specification import specification_from
from sesame_cad.worksheet import worksheet

MM = 25.4 / 72
NOTES = "Blue film. $5 a piece, 10 Ω.\nSecond line."


def made(**layout):
    sections = {
        "wire": {"diameter_mm": 0.5},
        "layout": {"rows": 2, "columns": 2, "loop_diameter_mm": 30, **layout},
        "output": {"formats": ["dst", "pes"], "notes": NOTES},
    }
    return design(specification_from(sections, "array", "test"))


@pytest.fixture(scope="module")
def small():
    return made()


def sheet_of(found):
    records = plan_records(found.pattern.plan, found.spec.patterns_machine())
    return worksheet(found, records)


def pages(found, paper="a4", sheet=None):
    data = worksheet_pdf(sheet or sheet_of(found), found.pattern, paper)
    return PdfReader(io.BytesIO(data)).pages


@pytest.fixture(scope="module")
def printed(small):
    """Pages of a small array on A4."""
    return pages(small)


def words(page):
    return " ".join(page.extract_text().split())


def drawn(page):
    """Polylines (n, 2) in mm on the page, by their colour."""
    found, colour, line = {}, None, []
    for operands, operator in ContentStream(page["/Contents"].get_object(), page.pdf).operations:
        if operator in {b"RG", b"G"}:
            colour = tuple(round(255 * float(part)) for part in operands * 3)[:3]
        elif operator == b"m":
            line = [[float(part) * MM for part in operands]]
        elif operator == b"l":
            line.append([float(part) * MM for part in operands])
        elif operator == b"S":
            found.setdefault(colour, []).append(np.array(line))
    return found


@pytest.mark.parametrize("paper", PAPERS_MM)
def test_two_pages_of_the_paper(small, paper):
    found = pages(small, paper)
    assert len(found) == 2
    for page in found:
        size = float(page.mediabox.width) * MM, float(page.mediabox.height) * MM
        assert sorted(size) == pytest.approx(PAPERS_MM[paper], abs=0.01)


def test_words(small, printed):
    sheet, text = sheet_of(small), words(printed[0])
    assert "array: worksheet" in text
    assert "array.dst, array.pes" in text
    for name, value in (*sheet.facts, *sheet.materials):
        assert name in text
        assert value in text
    for row in sheet.blocks:
        assert row.instruction in text
        assert row.thread.material in text
    assert "Blue film. $5 a piece, 10 Ω. Second line." in text


def test_numbers_follow_from_the_plan(small):
    own = {"speed_spm": 100.0, "wire_speed_spm": 50.0, "stop_time_s": 30.0}
    machine = small.spec.machine.model_copy(update=own)
    slow = replace(small, spec=small.spec.model_copy(update={"machine": machine}))
    sheet = sheet_of(slow)
    facts = dict(sheet.facts)
    plan, circuit = small.pattern.plan, small.pattern.circuit
    stitches = sum(len(run.needles) for block in plan.blocks for run in block.runs)
    assert facts["stitches"] == f"{stitches} in 4 blocks, 3 stops"
    laying = sum(len(run.needles) for k in (1, 3) for run in plan.blocks[k].runs)
    minutes = (stitches + laying) / 100 + 4 * 0.5
    assert facts["time, estimated"].startswith(f"{int(np.ceil(minutes))} min, at 100")
    assert sum(row.minutes for row in sheet.blocks) == pytest.approx(minutes)
    assert f"{np.ceil(circuit.wire_length_mm):.0f} mm of 0.5 mm" in facts["wire to load"]
    covers = [run.needles / 10 for run in plan.blocks[2].runs]
    way = sum(np.hypot(*np.diff(run, axis=0).T).sum() for run in covers)
    assert facts["cover thread"].startswith(f"{way / 1000:.2f} m")
    low, high = small.pattern.outline.outside.min(axis=0), small.pattern.outline.outside.max(axis=0)
    width, height = high - low
    assert facts["stretched, in the hoop"] == f"{width:.1f} × {height:.1f} mm"
    width, depth = small.states[0].footprint_mm
    assert facts["relaxed, cold"].startswith(f"{width + 0.5:.1f} × {depth + 0.5:.1f} mm")


def test_the_outline_is_1_to_1_with_the_hoop_s_centre(small, printed):
    page = printed[1]
    assert "stretched outline, 1:1" in words(page)
    cut = drawn(page)[255, 0, 0]
    outside = max(cut, key=len)
    expected = small.pattern.outline.outside
    moved = outside[: len(expected)] - expected
    np.testing.assert_allclose(moved, np.broadcast_to(moved[0], moved.shape), atol=2e-3)
    black = drawn(page)[0, 0, 0]
    middles = [
        line.mean(axis=0) for line in black if np.ptp(line, axis=0).max() == pytest.approx(10)
    ]
    assert len(middles) == 2
    np.testing.assert_allclose(middles, [moved[0], moved[0]], atol=2e-3)


def test_the_bar_is_100_mm(printed):
    lengths = [np.ptp(line, axis=0) for line in drawn(printed[1])[0, 0, 0]]
    assert any(length == pytest.approx([100, 0], abs=1e-3) for length in lengths)


def test_a_large_array_is_drawn_smaller_and_says_so():
    large = made(rows=4, columns=6, loop_diameter_mm=40, shape="none")
    page = pages(large)[1]
    assert "stretched outline, scale 1:2" in words(page)
    outside = max(drawn(page)[255, 0, 0], key=lambda line: np.ptp(line[:, 0]))
    expected = np.ptp(large.pattern.outline.outside, axis=0) / 2
    np.testing.assert_allclose(np.ptp(outside, axis=0), expected, atol=0.05)


def test_a_wide_array_turns_the_page():
    page = pages(made(rows=1, columns=6, loop_diameter_mm=32, shape="none"))[1]
    assert page.mediabox.width > page.mediabox.height
    assert "1:1" in words(page)


def test_nothing_is_drawn_beyond_the_margins(printed):
    for page in printed:
        for line in (line for own in drawn(page).values() for line in own):
            width, height = float(page.mediabox.width) * MM, float(page.mediabox.height) * MM
            assert line.min() > MARGIN_MM - 0.1
            assert np.all(line.max(axis=0) < np.array([width, height]) - MARGIN_MM + 0.1)


def test_long_instructions_go_on_on_another_page(small):
    sheet = sheet_of(small)
    long = replace(sheet, blocks=tuple(replace(sheet.blocks[1], number=k) for k in range(1, 25)))
    found = pages(small, sheet=long)
    assert len(found) == 3
    text = " ".join(map(words, found))
    assert "worksheet, continued" in text
    assert all(f" {k} shape-memory wire" in text for k in range(1, 25))


def test_lines_are_broken_between_words_and_within_long_ones():
    text = "one two three " + "x" * 200
    broken = wrapped(text, 40.0, 8.0)
    assert "".join(broken).replace(" ", "") == text.replace(" ", "")
    assert broken[0].startswith("one two three")
    assert all(text_width_mm(line, 8.0) <= 40.0 for line in broken)


def test_characters_that_the_font_lacks_are_shown_as_such():
    assert printable("Ω 中") == "Ω ?"


def test_the_same_bytes_whatever_the_seed_of_hashes(small):
    program = (
        "import hashlib, tests_of_worksheet as t; s = t.made();"
        "print(hashlib.sha256(t.worksheet_pdf(t.sheet_of(s), s.pattern, 'a4')).hexdigest())"
    )
    load = (
        "import importlib.util, sys; spec = importlib.util.spec_from_file_location("
        f"'tests_of_worksheet', {__file__!r}); m = importlib.util.module_from_spec(spec);"
        "sys.modules['tests_of_worksheet'] = m; spec.loader.exec_module(m);"
    )
    prints = {
        subprocess.run(
            [sys.executable, "-c", load + program],
            env={**os.environ, "PYTHONHASHSEED": seed},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for seed in ("1", "2")
    }
    assert len(prints) == 1
