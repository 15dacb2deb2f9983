"""3MF, GLB and VTU files of shapes, as other libraries read them."""

import json
import struct
from pathlib import Path

import lib3mf
import meshio
import numpy as np
import pygltflib
import pytest

from sesame_cad.bodies import flat_bodies, released_bodies
from sesame_cad.errors import DesignFileError
from sesame_cad.files.body_colours import COLOURS, rgba
from sesame_cad.files.glb import read_glb, write_glb
from sesame_cad.files.threemf import read_3mf, write_3mf
from sesame_cad.files.vtu import read_vtu, write_vtu
from sesame_cad.pipeline import design
from sesame_cad.preview import joined
from sesame_cad.solid_checks import shape_faults, shape_sizes_mm
from sesame_cad.solved_mesh import solved_mesh
from sesame_cad.specification import load_specification, specification_from

EXAMPLE = Path(__file__).parents[2] / "examples" / "large-array.toml"


@pytest.fixture(scope="module")
def alike():
    return design(load_specification(EXAMPLE, {"layout.rows": 2, "layout.columns": 3}))


@pytest.fixture(scope="module")
def coupled():
    layout = {"kind": "row", "diameters_mm": [40, 50]}
    wire = {"diameter_mm": 0.5}
    return design(specification_from({"wire": wire, "layout": layout}, "unequal", "test"))


@pytest.fixture(params=["alike", "coupled"])
def made(request):
    return request.getfixturevalue(request.param)


def _bodies(made):
    return released_bodies(made.spec, made.states[0])


def test_a_glb_file_holds_the_bodies_in_metres_with_y_up(made):
    bodies = _bodies(made)
    content = write_glb(bodies)
    read = pygltflib.GLTF2.load_from_bytes(content)
    assert {m.name for m in read.materials} == set(COLOURS)
    for material in read.materials:
        colour = np.array(material.pbrMetallicRoughness.baseColorFactor) * 255
        assert colour == pytest.approx(rgba(COLOURS[material.name]), abs=0.5)
    assert len(read.nodes) >= sum(len(body.places_mm) for body in bodies)
    size = np.ptp(np.concatenate([_placed(body) for body in bodies]), axis=0)
    assert np.ptp(read_glb(content), axis=0) == pytest.approx(size, abs=1e-4)
    up = _world_points(read)
    assert np.ptp(up, axis=0) == pytest.approx(size[[0, 2, 1]] / 1000, abs=1e-7)
    assert content == write_glb(_bodies(made))


def _placed(body):
    return np.concatenate([body.points + np.array([x, y, 0]) for x, y in body.places_mm])


def _world_points(read):
    """Follow the format itself: nodes, their matrices, meshes, accessors, the buffer."""
    out, blob = [], read.binary_blob()
    for node in read.nodes:
        if node.mesh is None:
            continue
        matrix = np.array(node.matrix or np.eye(4).ravel()).reshape(4, 4).T
        accessor = read.accessors[read.meshes[node.mesh].primitives[0].attributes.POSITION]
        start = read.bufferViews[accessor.bufferView].byteOffset + (accessor.byteOffset or 0)
        points = np.frombuffer(blob, "<f4", 3 * accessor.count, start).reshape(-1, 3)
        out.append(points @ matrix[:3, :3].T + matrix[:3, 3])
    return np.concatenate(out)


def test_a_glb_file_keeps_up_up():
    """A body that leans: mirrored or turned axes would show."""
    made = design(load_specification(EXAMPLE, {"layout.rows": 1, "layout.columns": 1}))
    (fabric, _wire) = _bodies(made)
    read = read_glb(write_glb([fabric]))
    assert read[:50] == pytest.approx(fabric.points[:50], abs=1e-4)
    top = _world_points(pygltflib.GLTF2.load_from_bytes(write_glb([fabric])))
    highest = fabric.points[np.argmax(fabric.points[:, 2])]
    assert top[np.argmax(top[:, 1])] == pytest.approx(
        highest[[0, 2, 1]] * [1, 1, -1] / 1e3, abs=1e-6
    )


def test_a_3mf_file_opens_elsewhere_with_its_colours(made):
    bodies = _bodies(made)
    content = write_3mf(bodies, 'the "2 & 3"')
    model = lib3mf.get_wrapper().CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromBuffer(content)
    assert reader.GetWarningCount() == 0
    assert model.GetUnit() == lib3mf.ModelUnit.MilliMeter
    materials = next(_each(model.GetBaseMaterialGroups(), "GetCurrentBaseMaterialGroup"))
    listed = {
        materials.GetName(k): materials.GetDisplayColor(k) for k in materials.GetAllPropertyIDs()
    }
    assert {
        name: [colour.Red, colour.Green, colour.Blue, colour.Alpha]
        for name, colour in listed.items()
    } == {name: rgba(colour) for name, colour in COLOURS.items()}
    meshes = list(_each(model.GetMeshObjects(), "GetCurrentMeshObject"))
    assert [mesh.GetName() for mesh in meshes] == [body.name for body in bodies]
    assert all(mesh.IsManifoldAndOriented() for mesh in meshes)
    for mesh, body in zip(meshes, bodies, strict=True):
        assert mesh.GetTriangleCount() == len(body.faces)
        number = mesh.GetObjectLevelProperty()[1]
        assert materials.GetName(number) == body.material
    box = model.GetOutbox()
    size = np.subtract(list(box.MaxCoordinate), list(box.MinCoordinate))
    points = np.concatenate([_placed(body) for body in bodies])
    assert size == pytest.approx(np.ptp(points, axis=0), abs=1e-4)
    assert read_3mf(content) == pytest.approx(points, abs=1e-6)


def _each(iterator, take):
    while iterator.MoveNext():
        yield getattr(iterator, take)()


def test_a_vtu_file_opens_elsewhere_with_its_fields(made, tmp_path):
    spec, state = made.spec, made.states[0]
    solved = solved_mesh(spec, state)
    file = tmp_path / "cold.vtu"
    file.write_bytes(write_vtu(solved))
    read = meshio.read(file)
    assert read.points == pytest.approx(solved.points_mm)
    assert read_vtu(file.read_bytes()) == pytest.approx(solved.points_mm)
    triangles = read.cells_dict["triangle"]
    assert (triangles == solved.mesh.triangles).all()
    assert (read.cells_dict["line"] == solved.wire_edges).all()
    of_fabric = read.cell_data_dict
    assert (of_fabric["material"]["triangle"] == 0).all()
    assert of_fabric["larger_stress_kPa"]["triangle"] == pytest.approx(
        solved.fabric.larger_stress * spec.fabric.modulus_kPa
    )
    assert read.point_data["flat_mm"][:, :2] == pytest.approx(solved.flat_mm)
    on_wire = np.isfinite(read.point_data["curvature_per_mm"])
    assert on_wire.sum() == len(np.unique(solved.wire_edges))


def test_fields_of_a_loop_that_stays_flat_are_those_of_the_hoop():
    """Flat: every line is stretched by 1 + ε, and the stress is that of an even stretch."""
    made = design(
        load_specification(
            EXAMPLE,
            {
                "layout.rows": 1,
                "layout.columns": 1,
                "wire.diameter_mm": 1.5,
                "layout.loop_diameter_mm": 75,
            },
        )
    )
    state, spec = made.states[0], made.spec
    assert not state.buckled
    solved = solved_mesh(spec, state)
    # the wire is stretched by next to nothing, and so is the fabric
    assert solved.fabric.larger_stretch == pytest.approx(1.3, rel=2e-3)
    assert solved.fabric.smaller_stretch == pytest.approx(1.3, rel=2e-3)
    even = (1.3**2 - 1) / 2 / (1 - spec.fabric.poisson)
    assert solved.fabric.larger_stress == pytest.approx(even, rel=5e-3)
    curvature = solved.curvature_per_mm
    assert curvature[np.isfinite(curvature)] == pytest.approx(2 / 75, rel=2e-3)


def test_files_are_as_large_as_the_shape_and_broken_ones_are_told(alike):
    sizes = shape_sizes_mm(alike)
    bodies = _bodies(alike)
    good = {
        "shape/cold.glb": write_glb(bodies),
        "shape/cold.3mf": write_3mf(bodies, "x"),
        "shape/cold.vtu": write_vtu(solved_mesh(alike.spec, alike.states[0])),
    }
    flat = flat_bodies(alike.spec, alike.states[0])
    wrong = {"shape/cold.glb": write_glb(flat), "shape/cold.3mf": write_3mf(flat, "x")}
    for path, content in good.items():
        kind = Path(path).suffix
        assert list(shape_faults(content, kind, sizes[path])) == []
        for broken in (b"", content[: len(content) // 2], b"\0" * 100):
            assert list(shape_faults(broken, kind, sizes[path]))
    for path, content in wrong.items():
        assert any(
            "height" in fault for fault in shape_faults(content, Path(path).suffix, sizes[path])
        )


def test_readers_tell_of_broken_files():
    for read in (read_3mf, read_glb, read_vtu):
        with pytest.raises(DesignFileError):
            read(b"nothing of the kind")
    header = struct.pack("<4sIIII", b"glTF", 2, 40, 20, 0x4E4F534A)
    with pytest.raises(DesignFileError):
        read_glb(header + json.dumps({"asset": {}}).encode())


def test_a_printable_solid_is_the_union_of_the_bodies(alike):
    bodies = _bodies(alike)
    solid = joined(bodies)
    points = np.concatenate([_placed(body) for body in bodies])
    assert solid.extents == pytest.approx(np.ptp(points, axis=0), abs=1e-3)
