"""SVG cut files, read back by svgelements and by the own reader."""

import io

import numpy as np
import pytest
import svgelements
from hypothesis import given, settings
from hypothesis import strategies as st

from patterns.outline import Outline
from patterns.registration import Mark
from sesame_cad.errors import DesignFileError
from sesame_cad.files.svg import outline_svg, read_outline_svg

DOTS_PER_MM = 96 / 25.4
SQUARE = np.array([(-60.0, -50.0), (60.0, -50.0), (60.0, 40.0), (-60.0, 40.1234)])
HOLE = np.array([(10.0, 10.0), (10.0, 20.0), (20.0005, 10.0)])
CROSS = Mark(
    70.0, 50.0, (np.array([(66.0, 50.0), (74.0, 50.0)]), np.array([(70.0, 46.0), (70.0, 54.0)]))
)
OUTLINE = Outline(SQUARE, (HOLE, HOLE - 30.0))


def library_lines(text: str) -> dict[str, list[np.ndarray]]:
    """Points of every path in mm on the page, by layer, as svgelements sees them."""
    document = svgelements.SVG.parse(io.StringIO(text), reify=True, ppi=96)
    lines: dict[str, list[np.ndarray]] = {}
    for group in document.select(lambda e: isinstance(e, svgelements.Group) and e.id is not None):
        for path in group.select(lambda e: isinstance(e, svgelements.Path)):
            points = [(p.x, p.y) for segment in path for p in [segment.end] if p is not None]
            lines.setdefault(group.id, []).append(np.array(points) / DOTS_PER_MM)
    return lines


def is_same_line(found: np.ndarray, expected: np.ndarray) -> bool:
    """Whether lines differ by no more than a shift, and are as many and as long."""
    if found.shape != expected.shape:
        return False
    return bool(np.allclose(found - found[0], expected - expected[0], atol=0.0021))


def closed(ring: np.ndarray) -> np.ndarray:
    return np.concatenate([ring, ring[:1]]) * (1, -1)


def test_an_independent_reader_finds_the_lines_in_millimetres():
    lines = library_lines(outline_svg(OUTLINE, (CROSS,), "plate"))
    assert is_same_line(lines["CUT"][0], closed(SQUARE))
    assert [is_same_line(line, closed(HOLE)) for line in lines["HOLE"]] == [True, True]
    for line, stroke in zip(lines["MARK"], CROSS.strokes, strict=True):
        assert is_same_line(line, stroke * (1, -1))
    np.testing.assert_allclose(np.ptp(lines["REFERENCE"][0], axis=0), (100, 0), atol=1e-3)


@pytest.mark.parametrize("wrong", [SQUARE * 1.001, SQUARE * (1, -1), SQUARE[::-1], SQUARE[:3]])
def test_the_comparison_can_fail(wrong):
    lines = library_lines(outline_svg(OUTLINE, (), "plate"))
    assert not is_same_line(lines["CUT"][0], closed(wrong))


def test_lines_keep_their_places_to_each_other():
    lines = library_lines(outline_svg(OUTLINE, (CROSS,), "plate"))
    apart = lines["HOLE"][0][0] - lines["CUT"][0][0]
    np.testing.assert_allclose(apart, (HOLE[0] - SQUARE[0]) * (1, -1), atol=0.0021)


def test_page_and_view_box_agree_and_hold_everything():
    text = outline_svg(Outline(HOLE, ()), (), "small")
    document = svgelements.SVG.parse(io.StringIO(text), ppi=25.4)
    assert (document.width, document.height) == pytest.approx(
        (document.viewbox.width, document.viewbox.height)
    )
    for lines in library_lines(text).values():
        for line in lines:
            assert np.all(line >= 0)
            assert np.all(line <= (document.width, document.height))


def test_inner_lines_come_first_and_the_bar_says_it_is_not_cut():
    text = outline_svg(OUTLINE, (CROSS,), "plate")
    places = [
        text.index(f'inkscape:label="{name}"') for name in ("HOLE", "CUT", "MARK", "REFERENCE")
    ]
    assert places == sorted(places)
    assert "100 mm - do not cut" in text
    assert "fill:none" in text


def test_names_are_escaped_and_bytes_reproduce():
    text = outline_svg(OUTLINE, (CROSS,), '<&"\n\x00>')
    read_outline_svg(text.encode())
    assert text == outline_svg(OUTLINE, (CROSS,), '<&"\n\x00>')


RINGS = st.lists(
    st.tuples(st.floats(-1000, 1000), st.floats(-1000, 1000)), min_size=3, max_size=8
).map(np.array)


@settings(deadline=None, max_examples=40)
@given(RINGS, st.lists(RINGS, max_size=3), st.lists(RINGS, max_size=2))
def test_the_own_reader_gives_the_design_back(outside, openings, strokes):
    text = outline_svg(Outline(outside, tuple(openings)), (Mark(0, 0, tuple(strokes)),), "x")
    outline, found = read_outline_svg(text.encode())
    wanted = [outside, *openings, *strokes]
    for ring, expected in zip([outline.outside, *outline.openings, *found], wanted, strict=True):
        np.testing.assert_allclose(ring, expected, atol=0.00051)


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        ('mm" height', 'px" height', "not in mm"),
        ('viewBox="0 0 ', 'viewBox="1 0 ', "viewBox"),
        (" Z", "", "not closed"),
        ('inkscape:label="CUT"', 'inkscape:label="KUT"', "no layer CUT"),
        ("data-upper-left-mm", "data-other", "does not say where"),
        ("<path ", '<path transform="scale(2)" ', "moves or scales"),
        ("M ", "m ", "no plain line"),
        ("<svg", "<!DOCTYPE x><svg", "entities"),
        ("</svg>", "", "no SVG"),
    ],
)
def test_tampered_files_are_refused(before, after, message):
    text = outline_svg(OUTLINE, (CROSS,), "plate")
    assert before in text
    with pytest.raises(DesignFileError, match=message):
        read_outline_svg(text.replace(before, after).encode())


@settings(deadline=None, max_examples=40)
@given(st.binary(max_size=200))
def test_random_bytes_are_refused(data):
    with pytest.raises(DesignFileError):
        read_outline_svg(data)
