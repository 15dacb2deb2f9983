import numpy as np
import pytest
import shapely

from patterns.circuit import Circuit, Crossing, CrossingKind
from patterns.couching import needle_clearance_mm
from patterns.cover import cover_spans_mm, covers
from patterns.laid_wire import laid_wire
from patterns.layout import Layout
from patterns.machine import Machine
from patterns.path import Line, WirePath
from patterns.plan import UNITS_PER_MM, quantise
from patterns.stitching import Stitching
from patterns.tangent_switch import grid_circuit

MACHINE, STITCHING, WIRE = Machine(500, 500, 0.75), Stitching(), 0.3
CLEAR = needle_clearance_mm(WIRE, MACHINE, STITCHING)
NEAR = WIRE + STITCHING.cover_reach_mm


def covers_of(circuit):
    laid = laid_wire(circuit.stages[0])
    settings = {"clear_mm": CLEAR, "wire_diameter_mm": WIRE, "stitching": STITCHING}
    return covers(circuit, 1, laid, **settings)


@pytest.mark.parametrize("diameter", [20.0, 25.0, 50.0])
def test_span_reaches_to_where_equal_circles_part(diameter):
    """Centre to centre the nearest distance from one circle to the other is d at cos a = ..."""
    circuit = grid_circuit(1, 2, diameter, 40.0)
    radius = diameter / 2
    # A point at angle a from the contact is sqrt(5 - 4 cos a) R from the other centre.
    angle = np.arccos((5 - (1 + NEAR / radius) ** 2) / 4)
    contact = circuit.crossings[0].first_mm
    reach = radius * angle + STITCHING.cover_spacing_mm
    assert cover_spans_mm(circuit, 1, WIRE, STITCHING)[0] == pytest.approx(
        [contact - reach, contact + reach], abs=0.006
    )


def test_span_at_the_terminals_reaches_farther_for_the_tail_is_straight():
    circuit = grid_circuit(1, 1, 25, 40)
    begin, end = cover_spans_mm(circuit, 1, WIRE, STITCHING)[0]
    along_tail = np.sqrt((12.5 + 0.0) ** 2 - (12.5 - NEAR) ** 2)
    assert 40 - begin == pytest.approx(np.sqrt((12.5 + NEAR) ** 2 - 12.5**2) + 0.4, abs=0.006)
    assert end - 40 > along_tail


def test_span_of_straight_wires_that_cross():
    """At 30 degrees two lines are d apart where one is d / sin 30 from the crossing."""
    slope = np.array([np.cos(np.pi / 6), np.sin(np.pi / 6)])
    circuit = Circuit(
        Layout((), ()),
        (),
        (WirePath((Line(-20, 0, 20, 0),)), WirePath((Line(*(-20 * slope), *(20 * slope)),))),
        (Crossing(CrossingKind.CONTACT, 0, 0, 20, 60),),
    )
    reach = NEAR / np.sin(np.pi / 6) + STITCHING.cover_spacing_mm
    assert cover_spans_mm(circuit, 1, WIRE, STITCHING)[0] == pytest.approx(
        [20 - reach, 20 + reach], abs=0.006
    )


@pytest.mark.parametrize(("rows", "columns"), [(1, 1), (2, 3), (4, 4)])
def test_laid_wire_is_covered_wherever_the_next_stage_comes_near(rows, columns):
    circuit = grid_circuit(rows, columns, 25.0, 40.0)
    first = circuit.stages[0]
    s = np.arange(0.0, first.length_mm - 3.0, 0.02)
    near = shapely.distance(shapely.points(first.at(s)[0]), circuit.stages[1].line_string(1e-3))
    spans = cover_spans_mm(circuit, 1, WIRE, STITCHING)
    covered = np.any((spans[:, :1] < s) & (s < spans[:, 1:]), axis=0)
    assert np.all(covered[near < NEAR - 0.002])


@pytest.mark.parametrize(("rows", "columns"), [(1, 1), (2, 3), (4, 4)])
def test_satin_alternates_closely_and_misses_the_wire(rows, columns):
    circuit = grid_circuit(rows, columns, 25.0, 40.0)
    line = circuit.stages[0].line_string(5e-4)
    for cover in covers_of(circuit):
        body = cover[2:-2]
        at = line.project(shapely.points(body))
        assert np.diff(at).min() > 0
        assert np.diff(at).max() <= STITCHING.cover_spacing_mm + 0.01
        point, tangent = circuit.stages[0].at(at)
        across = body - point
        side = np.sign(tangent[:, 0] * across[:, 1] - tangent[:, 1] * across[:, 0])
        assert np.all(side[1:] == -side[:-1])
        rounded = shapely.points(quantise(cover) / UNITS_PER_MM)
        assert shapely.distance(rounded, line).min() >= (WIRE + MACHINE.needle_diameter_mm) / 2


def test_one_cover_a_crossing_from_the_end_of_the_laid_wire_back():
    circuit = grid_circuit(3, 4, 25, 40)
    sewn = covers_of(circuit)
    assert len(sewn) == len(circuit.crossings)
    line = circuit.stages[0].line_string()
    middle = [line.project(shapely.points(cover.mean(axis=0))) for cover in sewn]
    assert middle == sorted(middle, reverse=True)


@pytest.mark.parametrize(("start", "end"), [((0, 0), (20, 0)), ((20, 0), (0, 0))])
def test_a_span_ends_with_the_laid_wire(start, end):
    circuit = Circuit(
        Layout((), ()),
        (),
        (WirePath((Line(*start, *end),)), WirePath((Line(18, -0.2, 40, 0.9),))),
        (Crossing(CrossingKind.CONTACT, 19, 0, abs(19 - start[0]), 21),),
    )
    span = cover_spans_mm(circuit, 1, WIRE, STITCHING)[0]
    assert (span[0] == 0) == (start[0] == 20)
    assert (span[1] == 20) == (end[0] == 20)
