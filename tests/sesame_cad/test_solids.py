"""Solids: one closed body, of the right height, also after a round through an STL file."""

import io

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from sesame_cad.errors import DesignFileError, InputError
from sesame_cad.files.stl import read_stl, write_stl
from sesame_cad.solids import array_solid, boundary_segments, cell_bodies, union_solid


def saddle(radius_mm, rise_mm):
    def surface(radius, angle_rad):
        x, y = radius_mm * radius * np.cos(angle_rad), radius_mm * radius * np.sin(angle_rad)
        return np.stack([x, y, rise_mm * radius**2 * np.cos(2 * angle_rad)], axis=1)

    return surface


def edge(surface):
    return lambda angle_rad: surface(np.ones_like(angle_rad), angle_rad)


def square(count, pitch_mm):
    place = (np.arange(count) - (count - 1) / 2) * pitch_mm
    return np.stack(np.meshgrid(place, place), axis=-1).reshape(-1, 2)


def cell(surface, wire_mm, thickness_mm, *, segments=None, rings=6, sides=12):
    return union_solid(
        cell_bodies(
            surface,
            edge(surface),
            wire_diameter_mm=wire_mm,
            fabric_thickness_mm=thickness_mm,
            rings=rings,
            segments=segments or boundary_segments(edge(surface)),
            sides=sides,
        )
    )


def assert_sound(mesh):
    """One closed body with a volume, here and as an independent reader finds it in the file."""
    data = write_stl(mesh, "test")
    loaded = trimesh.load(io.BytesIO(data), file_type="stl")
    for solid in (mesh, loaded, read_stl(data)):
        assert solid.is_watertight
        assert solid.volume > 0
        assert solid.body_count == 1
    assert loaded.volume == pytest.approx(mesh.volume, rel=1e-5)


@pytest.mark.parametrize(
    ("surface", "count", "pitch_mm", "wire_mm", "thickness_mm"),
    [
        (saddle(17, 6), 4, 34, 0.3, 0.3),
        (saddle(17, 6), 4, 34, 0.3, 0.27),
        (saddle(8.5, 3), 6, 17, 0.3, 0.24),
        (saddle(25, 0), 4, 50, 0.5, 0.27),
        (saddle(25, 0), 2, 50, 0.5, 0.5),
        # Found by trial: wires that all but coincide where they touch.
        (saddle(11.384114, 0.61), 3, 22.768228, 0.3, 0.3),
        (saddle(9.65545, 4.2748), 2, 19.3109001, 0.5, 0.45),
    ],
)
def test_arrays_are_one_closed_body_of_the_predicted_size(
    surface, count, pitch_mm, wire_mm, thickness_mm
):
    one = cell(surface, wire_mm, thickness_mm)
    whole = array_solid(one, square(count, pitch_mm))
    assert_sound(one)
    assert_sound(whole)
    edge_mm = edge(surface)(np.arange(4) * np.pi / 2)
    assert np.ptp(whole.vertices[:, 2]) == pytest.approx(np.ptp(edge_mm[:, 2]) + wire_mm, abs=1e-4)
    assert np.ptp(whole.vertices[:, 0]) == pytest.approx(
        np.ptp(edge_mm[:, 0]) + (count - 1) * pitch_mm + wire_mm, abs=1e-3
    )


@settings(deadline=None, max_examples=12)
@given(
    st.floats(5, 25),
    st.floats(0, 0.5),
    st.sampled_from([0, 1e-7, 1e-5, 1e-3, 0.01, -0.001, -0.05]),
    st.sampled_from([0.1, 0.5, 0.9, 1.0]),
    st.sampled_from([4, 8, 12]),
)
def test_any_saddle_joins_its_neighbours(radius_mm, rise, gap_mm, share, sides):
    surface = saddle(radius_mm, rise * radius_mm)
    one = cell(surface, 0.3, share * 0.3, rings=3, sides=sides)
    assert_sound(array_solid(one, square(2, 2 * radius_mm + gap_mm)))


def test_the_volume_is_that_of_disc_and_wire():
    one = cell(saddle(25, 0), 0.5, 0.25, segments=256, sides=32)
    disc = np.pi * 24.75**2 * 0.25
    wire = 2 * np.pi * 25 * np.pi * 0.25**2
    assert one.volume == pytest.approx(disc + wire, rel=0.01)


@pytest.mark.parametrize("tolerance_mm", [0.5, 0.05, 0.005])
def test_segments_keep_the_tolerance_and_are_no_more_than_needed(tolerance_mm):
    segments = boundary_segments(edge(saddle(25, 0)), tolerance_mm)
    assert segments % 4 == 0
    assert 25 * (1 - np.cos(np.pi / segments)) <= tolerance_mm
    assert 25 * (1 - np.cos(np.pi / (segments - 4))) > tolerance_mm


def test_a_tolerance_of_nothing_is_refused():
    with pytest.raises(InputError, match="no tolerance"):
        boundary_segments(edge(saddle(25, 0)), 0.0)


def test_impossible_cells_are_refused_with_every_fault():
    with pytest.raises(InputError) as caught:
        cell(saddle(25, 0), 0.3, 0.4, segments=30, rings=0, sides=6)
    assert len(caught.value.faults) == 4


def test_an_upright_wire_is_refused():
    def cylinder(radius, angle_rad):
        return np.stack(
            [radius * np.cos(angle_rad), 0 * radius, radius * np.sin(angle_rad)], axis=1
        )

    with pytest.raises(InputError, match="upright at 0°"):
        cell(cylinder, 0.1, 0.1, segments=16)


def test_stl_bytes_reproduce_and_carry_no_more_than_a_clean_name():
    one = cell(saddle(25, 3), 0.5, 0.25)
    data = write_stl(one, "cold\n\x00ä")
    assert data == write_stl(cell(saddle(25, 3), 0.5, 0.25), "cold\n\x00ä")
    assert data[:80] == b"binary STL in mm: cold".ljust(80)
    assert len(data) == 84 + 50 * len(one.faces)


def test_broken_stl_files_are_refused():
    data = write_stl(cell(saddle(25, 3), 0.5, 0.25), "x")
    for broken in (b"", data[:83], data[:-1], data + b"x", data[:80] + bytes(4)):
        with pytest.raises(DesignFileError):
            read_stl(broken)
    with pytest.raises(DesignFileError, match="no numbers"):
        read_stl(data[:96] + b"\xff" * 12 + data[108:])


def test_a_hole_is_noticed():
    """The check above can fail."""
    data = write_stl(cell(saddle(25, 3), 0.5, 0.25), "x")
    count = int.from_bytes(data[80:84], "little") - 1
    assert not read_stl(data[:80] + count.to_bytes(4, "little") + data[84:-50]).is_watertight
