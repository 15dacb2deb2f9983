"""DXF cut files: clean for ezdxf's audit, in millimetres, the same bytes every time."""

import io
from contextlib import suppress

import ezdxf
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from patterns.outline import Outline
from patterns.registration import Mark
from sesame_cad.errors import DesignFileError
from sesame_cad.files.dxf import outline_dxf, read_outline_dxf
from sesame_cad.files.dxf_vertices import all_vertices

SQUARE = np.array([(-60.0, -50.0), (60.0, -50.0), (60.0, 40.0), (-60.0, 40.1234)])
HOLE = np.array([(10.0, 10.0), (10.0, 20.0), (20.0005, 10.0)])
STROKES = (np.array([(66.0, 50.0), (74.0, 50.0)]), np.array([(70.0, 46.0), (70.0, 54.0)]))
MARKS = (Mark(70.0, 50.0, STROKES),)
OUTLINE = Outline(SQUARE, (HOLE, HOLE - 30.0))


def lines_of(text: str) -> list[tuple[str, bool, np.ndarray]]:
    space = ezdxf.read(io.StringIO(text)).modelspace()
    return [
        (line.dxf.layer, line.closed, np.array(line.get_points("xy")))
        for line in space.query("LWPOLYLINE")
    ]


def test_an_audit_finds_nothing():
    document = ezdxf.read(io.StringIO(outline_dxf(OUTLINE, MARKS)))
    audit = document.audit()
    assert (audit.errors, audit.fixes) == ([], [])
    assert (document.dxfversion, document.units) == ("AC1024", 4)
    assert {"CUT", "HOLE", "MARK", "REFERENCE"} <= {layer.dxf.name for layer in document.layers}
    assert len(document.modelspace()) == 6


def test_the_lines_are_closed_in_millimetres_and_inner_ones_come_first():
    lines = lines_of(outline_dxf(OUTLINE, MARKS))
    assert [layer for layer, _, _ in lines] == ["HOLE", "HOLE", "CUT", "MARK", "MARK", "REFERENCE"]
    assert [is_closed for _, is_closed, _ in lines] == [True] * 3 + [False] * 3
    for (_, _, found), expected in zip(lines, [HOLE, HOLE - 30, SQUARE, *STROKES], strict=False):
        np.testing.assert_allclose(found, expected, atol=1e-9)
    np.testing.assert_allclose(np.ptp(lines[-1][2], axis=0), (100, 0), atol=1e-9)


def test_the_comparison_can_fail():
    found = lines_of(outline_dxf(OUTLINE, MARKS))[2][2]
    for wrong in (SQUARE * 1.001, SQUARE * (1, -1), SQUARE[::-1]):
        assert not np.allclose(found, wrong, atol=1e-3)


def test_bytes_reproduce_and_the_option_is_put_back(monkeypatch):
    monkeypatch.setattr(ezdxf.options, "write_fixed_meta_data_for_testing", False)
    assert outline_dxf(OUTLINE, MARKS) == outline_dxf(OUTLINE, MARKS)
    assert ezdxf.options.write_fixed_meta_data_for_testing is False


RINGS = st.lists(
    st.tuples(st.floats(-1000, 1000), st.floats(-1000, 1000)), min_size=3, max_size=8
).map(np.array)


@settings(deadline=None, max_examples=15)
@given(RINGS, st.lists(RINGS, max_size=3), st.lists(RINGS, max_size=2))
def test_the_own_reader_gives_the_design_back(outside, openings, strokes):
    text = outline_dxf(Outline(outside, tuple(openings)), (Mark(0, 0, tuple(strokes)),))
    outline, found = read_outline_dxf(text.encode())
    wanted = [outside, *openings, *strokes]
    for ring, expected in zip([outline.outside, *outline.openings, *found], wanted, strict=True):
        np.testing.assert_allclose(ring, expected, atol=1e-9)


def changed(change) -> bytes:
    document = ezdxf.read(io.StringIO(outline_dxf(OUTLINE, MARKS)))
    change(document)
    stream = io.StringIO()
    document.write(stream)
    return stream.getvalue().encode()


def in_metres(document):
    document.units = 6


def opened(document):
    document.modelspace().query('*[layer=="HOLE"]')[0].closed = False


def without_cut(document):
    document.modelspace().delete_entity(document.modelspace().query('*[layer=="CUT"]')[0])


def with_circle(document):
    document.modelspace().add_circle((0, 0), 5, dxfattribs={"layer": "HOLE"})


def with_bulge(document):
    points = [(0, 0, 0.5), (1, 0, 0), (1, 1, 0)]
    document.modelspace().add_lwpolyline(points, format="xyb", dxfattribs={"layer": "MARK"})


def on_another_layer(document):
    document.modelspace().add_line((0, 0), (1, 1))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (in_metres, "units are 6"),
        (opened, "HOLE of the DXF is not closed"),
        (without_cut, "0 lines"),
        (with_circle, "CIRCLE"),
        (with_bulge, "no polyline"),
        (on_another_layer, "layer '0'"),
    ],
)
def test_tampered_files_are_refused(change, message):
    with pytest.raises(DesignFileError, match=message):
        read_outline_dxf(changed(change))


@settings(deadline=None, max_examples=40)
@given(st.binary(max_size=200))
def test_random_bytes_are_refused(data):
    with pytest.raises(DesignFileError):
        read_outline_dxf(data)


@settings(deadline=None, max_examples=15)
@given(st.data())
def test_damage_is_refused_or_harmless(data):
    lines = outline_dxf(OUTLINE, MARKS).split("\n")
    place = data.draw(st.integers(0, len(lines) - 1))
    with suppress(DesignFileError):
        read_outline_dxf("\n".join(lines[:place] + lines[place + 1 :]).encode())


def test_every_polyline_says_how_many_vertices_it_has():
    text = outline_dxf(OUTLINE, MARKS)
    lines = [one.split("\n  0\n")[0] for one in text.split("AcDbPolyline\n 90\n")[1:]]
    assert [int(one.split("\n")[0]) for one in lines] == [3, 3, 4, 2, 2, 2]
    assert [one.count("\n 10\n") for one in lines] == [3, 3, 4, 2, 2, 2]


def test_a_vertex_that_claims_to_stand_for_others_is_none():
    text, where = outline_dxf(OUTLINE, MARKS), "\n 20\n40.0\n"
    assert where in text
    with pytest.raises(DesignFileError):
        read_outline_dxf(text.replace(where, "\n 20\n-7.25e+307\n").encode())
    read, _ = read_outline_dxf(text.replace(where, "\n 20\n-7.25e307\n").encode())
    assert read.outside[:, 1].tolist() == [-50.0, -50.0, -7.25e307, 40.1234]
    assert all_vertices([], []).shape == (0, 2)
