import numpy as np
import pytest
from manifold3d import Manifold, Mesh

from sesame_cad.files.stl import read_stl, write_stl
from sesame_cad.sleeve_prediction.assembly import assemblies, beam_piece, constraint_piece
from sesame_cad.sleeve_prediction.solids import assembly_solids


@pytest.fixture(scope="module")
def parts(spec, prediction):
    """State −, its lower sleeve hot, as it comes back from files."""
    minus = assemblies(spec, prediction)[1]
    return {name: read_stl(write_stl(s, name)) for name, s in assembly_solids(spec, minus)}


def test_all_parts_are_watertight(parts):
    assert list(parts) == ["beam", "constraint", "upper-sleeve-cold", "lower-sleeve-hot"]
    for solid in parts.values():
        assert solid.is_watertight
        assert solid.volume > 0


def test_strips_keep_their_volume(spec, parts):
    thick = spec.beam.thickness_mm
    for name, piece in (("beam", beam_piece(spec)), ("constraint", constraint_piece(spec))):
        assert parts[name].volume == pytest.approx(piece.area_mm2 * thick, rel=2e-3)


def test_the_beam_is_bent_as_its_state(spec, prediction, parts):
    minus = assemblies(spec, prediction)[1]
    low = minus.state.points_m[:, 1].min() * 1e3 - spec.beam.thickness_mm / 2
    assert parts["beam"].bounds[0, 2] == pytest.approx(low, abs=0.02)
    assert parts["beam"].extents[1] == pytest.approx(2 * spec.beam.reach_mm, abs=0.05)


def test_the_constraint_is_straight_between_the_rivets(spec, parts):
    size = parts["constraint"].extents
    beam = spec.beam
    expected = [beam.constraint_length_mm, spec.constraint.width_mm, beam.thickness_mm]
    assert size == pytest.approx(expected, abs=1e-3)
    assert parts["constraint"].bounds[0, 0] == pytest.approx(-beam.hole_end_mm, abs=1e-3)


@pytest.mark.parametrize("which", [0, 1])
def test_sleeves_pass_through_the_window_of_the_constraint(spec, prediction, which):
    assembly = assemblies(spec, prediction)[which]
    parts = dict(assembly_solids(spec, assembly))
    constraint = _manifold(parts.pop("constraint"))
    for name in [name for name in parts if name.endswith(("cold", "hot"))]:
        assert (constraint ^ _manifold(parts[name])).volume() == 0, name


def _manifold(solid):
    return Manifold(Mesh(solid.vertices.astype(np.float32), solid.faces.astype(np.uint32)))


def test_rows_stand_off_both_faces(spec, prediction):
    """On the straight beam: valleys beside it, crests at the couple's arm."""
    plus, minus = assemblies(spec, prediction)
    angle = np.linspace(0, 2 * np.pi, 721)
    for row in (*plus.rows, *minus.rows):
        wire = row.loop(np.ones_like(angle), angle)
        sign = 1 if row.upper else -1
        assert sign * wire[0, 2] == pytest.approx(row.couple.arm_m * 1e3)
        assert (sign * wire[:, 2]).min() >= spec.wire.diameter_mm / 2 - 1e-9
    assert plus.rows[0].centres_mm[0] + spec.beam.hole_end_mm == pytest.approx(
        spec.sleeve_place.start_mm + spec.compressed_pitch_mm / 2
    )


def test_titles_tell_states(spec, prediction):
    plus, minus = assemblies(spec, prediction)
    heights = [f"{abs(one.state.height_m) * 1e3:.1f} mm" for one in (plus, minus)]
    assert plus.title == f"both sleeves cold: arched up by {heights[0]}"
    assert minus.title == f"lower sleeve hot: arched down by {heights[1]}"
