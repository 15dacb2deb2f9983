"""Pictures: drawn, reproducible, and showing what they should."""

import io

import numpy as np
import pytest
from PIL import Image

from patterns.circuit import Circuit
from patterns.layout import Layout
from patterns.loop import Loop
from patterns.loop_order import loops_in_order
from patterns.outline import Outline
from patterns.path import Arc, Line, WirePath
from patterns.plan import Block, BlockKind, Run, StitchPlan
from patterns.registration import Mark
from sesame_cad.drawing_colours import COVER, STAGES
from sesame_cad.pictures.plan import plan_picture
from sesame_cad.pictures.rendering import View, fabric_patch, projected_bounds, render
from sesame_cad.pictures.shapes import ShapeView, shapes_picture


def pixels(data):
    return np.asarray(Image.open(io.BytesIO(data)).convert("RGB")).astype(int)


def count(picture, colour):
    wanted = [int(colour[k : k + 2], 16) for k in (1, 3, 5)]
    return int(np.sum(np.abs(picture - wanted).max(axis=2) < 30))


def two_loops():
    layout = Layout((Loop(-10, 0, 20), Loop(10, 0, 20)), ())
    first = WirePath(
        (Line(-20, -20, -20, 0), Arc(-10, 0, 10, np.pi, -np.pi), Arc(10, 0, 10, np.pi, np.pi))
    )
    second = WirePath((Arc(10, 0, 10, 0, np.pi), Arc(-10, 0, 10, 0, -np.pi), Line(-20, 0, -20, 20)))
    return Circuit(layout, (), (first, second), ())


def block(kind, *points):
    return Block(kind, "", (Run((0, 0), np.array(points)),))


CORNERS = np.array([(-25.0, -22.0), (25.0, -22.0), (25.0, 22.0), (-25.0, 22.0)])
MARKS = (Mark(30, 0, (np.array([(28.0, 0.0), (32.0, 0.0)]),)),)
PLAN = StitchPlan(
    (
        block(BlockKind.WIRE, (-210, -100), (-190, -80)),
        block(BlockKind.COVER, (-20, -50), (20, -40), (-20, -30), (20, -20)),
        block(BlockKind.WIRE, (-210, 100), (-190, 80)),
    )
)


def test_the_plan_shows_all_stages_and_the_covers_and_reproduces():
    data = plan_picture(two_loops(), PLAN, Outline(CORNERS, ()), MARKS)
    picture = pixels(data)
    # A dot or an arrow head would be less.
    assert min(count(picture, colour) for colour in STAGES[:2]) > 1000
    assert count(picture, COVER) > 0
    assert data == plan_picture(two_loops(), PLAN, Outline(CORNERS, ()), MARKS)


def test_without_a_cover_none_is_shown():
    bare = StitchPlan(PLAN.blocks[::2])
    assert count(pixels(plan_picture(two_loops(), bare, Outline(CORNERS, ()), ())), COVER) == 0


def test_loops_are_numbered_as_the_wire_reaches_them():
    circuit = two_loops()
    assert loops_in_order(circuit) == (0, 1)
    turned = Circuit(circuit.layout, (), circuit.stages[::-1], ())
    assert loops_in_order(turned) == (1, 0)


def saddle(rise_mm):
    def surface(radius, angle_rad):
        x, y = 10 * radius * np.cos(angle_rad), 10 * radius * np.sin(angle_rad)
        return np.stack([x, y, rise_mm * radius**2 * np.cos(2 * angle_rad)], axis=1)

    return surface


def test_shapes_are_drawn_at_one_scale_and_reproduce():
    centres = np.array([(-10.0, 0.0), (10.0, 0.0)])
    views = [ShapeView("cold", saddle(6), centres, 0.5), ShapeView("hot", saddle(3), centres, 0.5)]
    data = shapes_picture(views)
    picture = pixels(data)
    left, right = np.array_split(picture[80:], 2, axis=1)
    coloured = [(half.max(axis=2) - half.min(axis=2) > 25) for half in (left, right)]
    heights = [np.ptp(np.flatnonzero(half.any(axis=1))) for half in coloured]
    assert heights[0] > heights[1] > 0
    assert data == shapes_picture(views)


@pytest.fixture
def red_disc():
    return fabric_patch(saddle(0), np.array([1.0, 0.0, 0.0]))


def test_a_disc_from_above_covers_its_area(red_disc):
    image = render(
        [red_disc],
        np.zeros((1, 2)),
        View(-90, 90),
        corner_mm=np.array([-12.0, -12.0]),
        mm_per_pixel=0.1,
        size=(240, 240),
    )
    assert np.sum(1 - image[..., 1]) / np.sum(1 - image[120, 120, 1]) * 0.01 == pytest.approx(
        np.pi * 100, rel=0.01
    )


def test_the_nearer_loop_hides_the_farther_one(red_disc):
    """Seen from the side of -y, the loop at -y is drawn over the one behind it, in either order."""
    upright = fabric_patch(lambda r, a: saddle(4)(r, a)[:, [0, 2, 1]], red_disc.colour)
    centres = np.array([(0.0, -5.0), (8.0, 5.0)])
    options = {"corner_mm": np.array([-12.0, -12.0]), "mm_per_pixel": 0.2, "size": (120, 180)}
    pictures = [render([upright], c, View(-90, 0), **options) for c in (centres, centres[::-1])]
    np.testing.assert_array_equal(*pictures)


def test_bounds_hold_every_copy(red_disc):
    low, high = projected_bounds([red_disc], np.array([(-10.0, 0.0), (10.0, 5.0)]), View(-90, 90))
    np.testing.assert_allclose((low, high), [(-20, -10), (20, 15)], atol=1e-9)
