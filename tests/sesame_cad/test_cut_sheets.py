"""Sheets to cut: what is written reads back, here and by other programs."""

import io
from dataclasses import replace
from math import pi

import ezdxf
import numpy as np
import pytest
from shapely import Polygon
from svgelements import SVG, Circle, Path

from patterns.cut_coupon import hole_coupon
from patterns.cut_order import Cut, cuts_in_order
from patterns.cut_piece import Hole
from patterns.hooks import SleevePlace
from patterns.mat import Mat
from patterns.nesting import nest
from sesame_cad.errors import DesignFileError
from sesame_cad.files.cut_dxf import cut_dxf, read_cut_dxf
from sesame_cad.files.cut_line import CUT, HOLE, cut_line, same_lines
from sesame_cad.files.cut_svg import cut_svg, read_cut_svg
from sesame_cad.specification.beam import BeamSection

MAT = Mat(200.0, 120.0)


@pytest.fixture(scope="module")
def pieces():
    beam = BeamSection().beam(SleevePlace(11.0, 69.0)).piece()
    (nested,) = nest([beam, hole_coupon([2.8, 3.0, 3.2], 1.5)], MAT, 3.0)
    return nested.pieces


def lines_of(pieces, overcut_mm=0.0, kerf_mm=0.0):
    return tuple(map(cut_line, cuts_in_order(pieces, kerf_mm, overcut_mm)))


def by_layer(lines):
    return tuple(line for layer in (HOLE, CUT) for line in lines if line.layer == layer)


@pytest.mark.parametrize("overcut", [0.0, 1.5])
def test_what_is_written_reads_back(pieces, overcut):
    lines = lines_of(pieces, overcut, kerf_mm=0.2)
    assert {line.closed for line in lines} == {overcut == 0}
    svg, dxf = cut_svg(lines, MAT, "sheet"), cut_dxf(lines, MAT)
    assert same_lines(read_cut_svg(svg.encode()), by_layer(lines))
    assert same_lines(read_cut_dxf(dxf.encode()), lines)
    assert (svg, dxf) == (cut_svg(lines, MAT, "sheet"), cut_dxf(lines, MAT))


def test_a_line_that_is_a_little_off_is_another():
    line = cut_line(Cut("strip", Hole(5.0, 6.0, 3.0), True, 0.0))
    assert not line.same_as(replace(line, vertices=line.vertices + 0.01))
    assert not line.same_as(replace(line, layer=CUT))
    assert not line.same_as(replace(line, closed=False))


def test_a_bulge_that_is_a_little_off_is_another(pieces):
    line = next(line for line in lines_of(pieces) if line.layer == CUT)
    bent = line.vertices.copy()
    bent[np.flatnonzero(bent[:, 2])[0], 2] += 0.05
    assert not line.same_as(replace(line, vertices=bent))


def test_an_overcut_goes_on_past_the_start_of_a_hole():
    line = cut_line(Cut("strip", Hole(0.0, 0.0, 4.0), True, pi))
    assert not line.closed
    # round once, clockwise from (2, 0), and a quarter more
    assert np.allclose(line.vertices[[0, 2, -1], :2], [(2, 0), (2, 0), (0, -2)], atol=1e-9)


def test_another_program_finds_the_dxf_sound_and_of_the_same_area(pieces):
    document = ezdxf.read(io.StringIO(cut_dxf(lines_of(pieces), MAT)))
    assert not document.audit().errors
    assert document.units == ezdxf.units.MM
    drawn = [one for one in document.modelspace() if one.dxf.layer != "REFERENCE"]
    kinds = {(one.dxf.layer, one.dxftype()) for one in drawn}
    assert kinds == {(HOLE, "CIRCLE"), (CUT, "LWPOLYLINE")}
    outsides = [one for one in drawn if one.dxf.layer == CUT]
    assert all(one.closed for one in outsides)
    for one, piece in zip(outsides, pieces, strict=True):
        path = ezdxf.path.make_path(one)
        ring = Polygon([(p.x, p.y) for p in path.flattening(0.001)])
        assert ring.is_valid
        assert ring.area == pytest.approx(piece.outside.area_mm2, rel=1e-5)


def test_inner_lines_of_a_piece_come_before_its_outside(pieces):
    layers = [line.layer for line in lines_of(pieces)]
    first = layers.index(CUT)
    assert layers == [HOLE] * first + [CUT] + [HOLE] * (len(layers) - first - 2) + [CUT]
    svg = cut_svg(lines_of(pieces), MAT, "sheet")
    assert svg.index('id="HOLE"') < svg.index('id="CUT"')


def test_another_program_reads_the_svg_in_millimetres(pieces):
    drawing = SVG.parse(io.StringIO(cut_svg(lines_of(pieces), MAT, "sheet")), ppi=25.4)
    assert (drawing.width, drawing.height) == pytest.approx((200.0, 128.0))
    layers = {group.id: list(group) for group in drawing if getattr(group, "id", None)}
    holes = [one for one in layers[HOLE] if isinstance(one, Circle)]
    right = sorted(hole.diameter_mm for piece in pieces for hole in piece.holes)
    assert sorted(2 * hole.rx for hole in holes) == pytest.approx(right, abs=1e-3)
    for one, piece in zip(layers[CUT], pieces, strict=True):
        path = Path(one)
        ring = Polygon([(p.x, p.y) for p in (path.point(t) for t in np.linspace(0, 1, 4001))])
        assert ring.area == pytest.approx(piece.outside.area_mm2, rel=2e-3)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('id="CUT"', 'id="CUT"', None),
        ('label="CUT"', 'label="OTHER"', "no layer CUT"),
        ("mm", "in", "not in mm"),
        ("<circle", "<ellipse", "more than lines"),
        ("0 0,0", "0 1,0", "not made of M, L, A and Z"),
        ('r="', 'q="', "no centre or radius"),
    ],
)
def test_a_spoilt_svg_is_refused(pieces, old, new, said):
    text = cut_svg(lines_of(pieces), MAT, "sheet").replace(old, new)
    if said is None:
        read_cut_svg(text.encode())
        return
    with pytest.raises(DesignFileError, match=said):
        read_cut_svg(text.encode())


def test_a_dxf_with_other_things_is_refused(pieces):
    document = ezdxf.read(io.StringIO(cut_dxf(lines_of(pieces), MAT)))
    document.modelspace().add_line((0, 0), (1, 1), dxfattribs={"layer": CUT})
    stream = io.StringIO()
    document.write(stream)
    with pytest.raises(DesignFileError, match="holds a LINE, no line to cut"):
        read_cut_dxf(stream.getvalue().encode())
    document.modelspace()[-1].dxf.layer = "PENCIL"
    stream = io.StringIO()
    document.write(stream)
    with pytest.raises(DesignFileError, match="layer 'PENCIL'"):
        read_cut_dxf(stream.getvalue().encode())
