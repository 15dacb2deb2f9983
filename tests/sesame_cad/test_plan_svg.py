"""The drawing of the plan, read by another library: layers, lengths, counts and places."""

import csv
import io
from dataclasses import replace

import numpy as np
import pytest
from svgelements import SVG, Group, Move
from svgelements import Path as SvgPath

from patterns.plan import BlockKind
from sesame_cad.files.block_list import COLUMNS, block_list_csv
from sesame_cad.files.plan_svg import plan_svg
from sesame_cad.files.sheet import lay_out
from sesame_cad.pipeline import pattern
from sesame_cad.specification import specification_from
from sesame_cad.specification.machine import MachineSection
from sesame_cad.threads import threads_of

WIRE_MM = 0.5


@pytest.fixture(scope="module")
def laid():
    layout = {"rows": 2, "columns": 2, "loop_diameter_mm": 30, "shape": "none"}
    return pattern(
        specification_from({"wire": {"diameter_mm": WIRE_MM}, "layout": layout}, "a", "")
    )


@pytest.fixture(scope="module")
def drawing(laid):
    return plan_svg(laid, WIRE_MM, "array")


@pytest.fixture(scope="module")
def layers(drawing):
    """Paths by layer, in mm."""
    svg = SVG.parse(io.StringIO(drawing), ppi=25.4)
    groups = [group for group in svg.elements() if isinstance(group, Group) and group.id]
    return {
        group.id: [SvgPath(part) for part in group if isinstance(part, SvgPath)] for group in groups
    }


def test_layers_and_page(laid, drawing, layers):
    blocks = range(1, len(laid.plan.blocks) + 1)
    assert list(layers)[:4] == ["OUTLINE", "MARKS", "WIRE-1", "WIRE-2"]
    assert {f"{kind}-{k}" for kind in ("STITCHES", "NEEDLES") for k in blocks} <= set(layers)
    assert drawing.count('inkscape:groupmode="layer"') == 6 + 2 * len(blocks)
    sheet = lay_out(laid.outline, laid.marks)
    box = f'viewBox="0 0 {sheet.width_mm:.3f} {sheet.height_mm:.3f}"'
    assert f'width="{sheet.width_mm:.3f}mm" height="{sheet.height_mm:.3f}mm" {box}' in drawing


def test_wire_is_as_long_and_lies_where_it_is_laid(laid, layers):
    sheet = lay_out(laid.outline, laid.marks)
    for k, stage in enumerate(laid.circuit.stages, start=1):
        (path,) = layers[f"WIRE-{k}"]
        assert path.length(error=1e-5) == pytest.approx(stage.length_mm, abs=0.02)
        share = np.linspace(0, 1, 41)
        found = np.array([(p.x, p.y) for p in (path.point(s, error=1e-5) for s in share)])
        expected = sheet.on_page(stage.at(share * stage.length_mm)[0])
        np.testing.assert_allclose(found, expected, atol=0.02)


def test_outline_is_the_cut_line(laid, layers):
    assert len(layers["OUTLINE"]) == len(laid.outline.rings)
    for path, ring in zip(layers["OUTLINE"], laid.outline.rings, strict=True):
        length = np.hypot(*(np.roll(ring, -1, axis=0) - ring).T).sum()
        assert path.length() == pytest.approx(length, abs=0.05)


def test_stitches_and_needle_points_are_those_of_the_plan(laid, layers):
    sheet = lay_out(laid.outline, laid.marks)
    for k, block in enumerate(laid.plan.blocks, start=1):
        needles = [sheet.on_page(run.needles / 10) for run in block.runs]
        (stitches,), (dots,) = layers[f"STITCHES-{k}"], layers[f"NEEDLES-{k}"]
        assert sum(isinstance(part, Move) for part in stitches) == len(block.runs)
        ends = np.array([(part.end.x, part.end.y) for part in stitches])
        np.testing.assert_allclose(ends, np.concatenate(needles), atol=1e-3)
        places = np.array([(part.end.x, part.end.y) for part in dots if isinstance(part, Move)])
        np.testing.assert_allclose(places, np.concatenate(needles), atol=1e-3)


def test_few_elements_whatever_the_stitches(laid, drawing):
    stitches = sum(len(run.needles) for block in laid.plan.blocks for run in block.runs)
    assert stitches > 400
    assert drawing.count("<path") < 40
    assert drawing == plan_svg(laid, WIRE_MM, "array")


def test_names_with_marks_of_the_language_do_no_harm(laid):
    text = plan_svg(laid, WIRE_MM, "<a & b>\x00")
    assert "<title>&lt;a &amp; b&gt; </title>" in text


def test_the_list_of_blocks_holds_a_line_a_block(laid):
    plan = replace(laid.plan, blocks=(replace(laid.plan.blocks[0], instruction='a "b", c\nd'),))
    (row,) = csv.DictReader(io.StringIO(block_list_csv(plan, threads_of(plan, MachineSection()))))
    assert tuple(row) == COLUMNS
    assert row["instruction"] == 'a "b", c\nd'
    listed = block_list_csv(laid.plan, threads_of(laid.plan, MachineSection()))
    rows = [*csv.DictReader(io.StringIO(listed))]
    assert [row["block"] for row in rows] == ["1", "2", "3", "4"]
    assert [row["head"] for row in rows] == ["thread", "wire", "thread", "wire"]
    for row, block in zip(rows, laid.plan.blocks, strict=True):
        assert int(row["stitches"]) == sum(len(run.needles) for run in block.runs)
        assert block.kind is BlockKind.COVER or row["colour_name"] != "green"
