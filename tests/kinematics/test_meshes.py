"""Meshes of a person's own description: found in its folder, made light, missing ones named, hit by their hulls."""

from __future__ import annotations

import json
import struct
import zipfile

import numpy as np
import pytest
import trimesh

from app.errors import InputError
from app.kinematics import CollisionWorld, load_robot
from app.kinematics.meshes import _MOST_TRIANGLES
from app.kinematics.shapes import ball
from app.kinematics.solids import missing_meshes, robot_shapes, robot_solids
from tests.kinematics.description.making import description, line

KINDS = ["stl", "obj", "ply", "glb", "dae"]


def robot_with(folder, name, *, where="urdf", scale="", extra=""):
    """Two joints; the first link is the mesh, 0.3 m up."""
    mesh = f'<geometry><mesh filename="{name}"{scale}/></geometry>'
    visual = f'<visual><origin xyz="0 0 0.3"/>{mesh}{extra}</visual>'
    text = description(line(2)).replace('<link name="l1"/>', f'<link name="l1">{visual}</link>')
    path = folder / where / "arm.urdf"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return load_robot(path)


@pytest.fixture
def package(tmp_path):
    folder = tmp_path / "ws" / "pack"
    (folder / "meshes").mkdir(parents=True)
    (folder / "package.xml").write_text("<package/>")
    for kind in KINDS:
        trimesh.creation.box((0.2, 0.1, 0.4)).export(folder / "meshes" / f"box.{kind}")
    trimesh.creation.box((1, 1, 1)).export(tmp_path / "outside.stl")
    return folder


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    "name", ["package://pack/meshes/box.{}", "../meshes/box.{}", "package://renamed/meshes/box.{}"]
)
def test_a_mesh_is_found_by_its_package_or_its_path_and_drawn_in_its_place(package, kind, name):
    robot = robot_with(package, name.format(kind))
    (shape,) = [s for s in robot_shapes(robot) if s.kind == "mesh"]
    assert shape.body == 1 and missing_meshes(robot) == ()
    (solid,) = robot_solids(robot)
    assert solid.mesh is not None and len(solid.mesh.triangles) == 12
    assert np.ptp(solid.points, axis=0) == pytest.approx([0.2, 0.1, 0.4], abs=1e-6)
    assert solid.points[:, 2].mean() == pytest.approx(0.3)


def test_a_scale_makes_metres_of_millimetres_and_a_mirror_turns_the_triangles(package):
    trimesh.creation.box((200, 100, 400)).export(package / "meshes" / "mm.stl")
    robot = robot_with(package, "../meshes/mm.stl", scale=' scale="0.001 -0.001 0.001"')
    (solid,) = robot_solids(robot)
    assert np.ptp(solid.points, axis=0) == pytest.approx([0.2, 0.1, 0.4], abs=1e-6)
    mesh = trimesh.Trimesh(solid.mesh.vertices, solid.mesh.triangles, process=False)
    assert mesh.volume == pytest.approx(0.008, rel=1e-5)


def test_a_heavy_mesh_is_made_light_and_keeps_its_size(package):
    sphere = trimesh.creation.icosphere(subdivisions=6, radius=0.2)
    assert len(sphere.faces) > 10 * _MOST_TRIANGLES
    sphere.export(package / "meshes" / "ball.stl")
    (solid,) = robot_solids(robot_with(package, "../meshes/ball.stl"))
    assert len(solid.mesh.triangles) <= _MOST_TRIANGLES
    radii = np.linalg.norm(solid.mesh.vertices - [0, 0, 0.3], axis=1)
    assert radii.min() > 0.198 and radii.max() < 0.202


def test_what_stands_in_the_way_of_a_mesh_hits_its_hull(package):
    robot = robot_with(package, "../meshes/box.stl")
    world = CollisionWorld(robot, obstacles=[ball((0.15, 0.0, 0.4), 0.06, link="post")])
    assert [(p.a, p.b) for p in world.check(np.zeros(2))] == [("l1", "post")]
    assert (
        CollisionWorld(robot, obstacles=[ball((0.25, 0.0, 0.4), 0.06, link="post")]).check(np.zeros(2)) == []
    )


@pytest.mark.parametrize(
    "name",
    [
        "package://pack/meshes/gone.stl",
        "../../../outside.stl",
        "package://../../outside.stl",
        "file://{outside}",
        "/etc/passwd",
        "http://example.org/box.stl",
        "",
        "x" * 2000 + ".stl",
    ],
)
def test_what_is_not_in_the_folder_is_named_and_not_opened(package, tmp_path, name):
    robot = robot_with(package, name.format(outside=tmp_path / "outside.stl"))
    (line_,) = missing_meshes(robot)
    assert "not in" in line_ and len(line_) < 300
    assert all(shape.kind != "mesh" for shape in robot_shapes(robot))


@pytest.mark.parametrize(
    "content", [b"", b"solid x\nendsolid x\n", b"\x00" * 84, b"not a mesh", b"\xff" * 4000]
)
@pytest.mark.parametrize("kind", ["stl", "dae", "obj"])
def test_a_broken_mesh_is_named_with_the_reason(package, content, kind):
    (package / "meshes" / f"bad.{kind}").write_bytes(content)
    robot = robot_with(package, f"../meshes/bad.{kind}")
    (line_,) = missing_meshes(robot)
    assert f"bad.{kind}: " in line_ and "\n" not in line_


def test_a_link_out_of_the_folder_is_not_followed(package, tmp_path):
    (package / "meshes" / "link.stl").symlink_to(tmp_path / "outside.stl")
    assert "not in" in missing_meshes(robot_with(package, "../meshes/link.stl"))[0]


def test_the_colour_of_the_description_goes_before_that_of_the_file(package):
    red = '<material name="m"><color rgba="1 0 0 1"/></material>'
    assert robot_solids(robot_with(package, "../meshes/box.dae", extra=red))[0].colour == (1.0, 0.0, 0.0)


def zipped(folder, path, more=()):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as held:
        for file in sorted(folder.rglob("*")):
            if file.is_file():
                held.write(file, file.relative_to(folder.parent))
        for name, data in more:
            held.writestr(name, data)
    return path


@pytest.fixture
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path / "cache"


def test_a_folder_or_a_zip_of_a_robot_is_loaded_with_its_meshes(package, tmp_path, cache):
    robot_with(package, "package://pack/meshes/box.stl")
    for place in (package, zipped(package, tmp_path / "arm.zip")):
        robot = load_robot(place)
        assert robot.joint_count == 2 and missing_meshes(robot) == ()
        assert load_robot(robot.address).flange == robot.flange
    assert len(list((cache / "teachframe" / "robots").iterdir())) == 1


def test_several_robots_in_a_folder_are_listed(package):
    robot_with(package, "../meshes/box.stl")
    robot_with(package, "../meshes/box.stl", where="urdf/two")
    with pytest.raises(InputError, match=r"2 robots in it: urdf/arm\.urdf, urdf/two/arm\.urdf"):
        load_robot(package)


@pytest.mark.parametrize(
    "more, problem",
    [
        ([("../../evil.urdf", "x")], "leads out of it"),
        ([("/tmp/evil.urdf", "x")], "leads out of it"),
        ([(f"f{k}", "") for k in range(5001)], "over 5000 files"),
        ([], "no robot description"),
    ],
)
def test_a_zip_that_cannot_be_is_refused_and_leaves_nothing(package, tmp_path, cache, more, problem):
    with pytest.raises(InputError, match=problem):
        load_robot(zipped(package, tmp_path / "arm.zip", more))
    assert not (tmp_path / "evil.urdf").exists()


def test_a_damaged_zip_and_a_bomb_are_refused(package, tmp_path, cache, monkeypatch):
    path = zipped(package, tmp_path / "arm.zip", [("zeros.stl", bytes(3_000_000))])
    data = path.read_bytes()
    monkeypatch.setattr("app.kinematics.description.package._LARGEST", 1_000_000)
    with pytest.raises(InputError, match="grows to over"):
        load_robot(path)
    for cut in (10, 300, len(data) - 40):
        path.write_bytes(data[:cut])
        with pytest.raises(InputError, match=r"arm\.zip"):
            load_robot(path)
    assert list((cache / "teachframe" / "robots").iterdir()) == []


def gltf(change):
    """A small GLB whose head was changed."""
    whole = trimesh.creation.box((0.2, 0.1, 0.4)).export(file_type="glb")
    size = struct.unpack("<I", whole[12:16])[0]
    tree, rest = json.loads(whole[20 : 20 + size]), whole[20 + size :]
    change(tree)
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack("<I", len(text)) + b"JSON" + text + rest
    return b"glTF" + struct.pack("<II", 2, 12 + len(body)) + body


BOXES = {
    "zeros that need no room": gltf(lambda t: [a.update(count=3 * 10**8) for a in t["accessors"]]),
    "fewer than none": gltf(lambda t: t["accessors"][0].update(count=-(10**9))),
    "words": gltf(lambda t: t["accessors"][0].update(count="many")),
    "cut": gltf(lambda t: None)[:60],
}


@pytest.mark.parametrize("name", BOXES)
def test_a_head_that_promises_more_than_there_is(package, name):
    (package / "meshes" / "a.glb").write_bytes(BOXES[name])
    robot = robot_with(package, "../meshes/a.glb")
    robot_shapes(robot)
    (line,) = missing_meshes(robot)
    assert "a.glb" in line


def test_what_a_reader_warns_of_does_not_reach_the_terminal(package, caplog, capfd):
    whole = trimesh.creation.box((0.2, 0.1, 0.4)).export(file_type="ply", encoding="ascii").decode()
    (package / "meshes" / "a.ply").write_text(
        whole.replace("element vertex", "comment TextureFile a.png\nelement vertex", 1)
    )
    (package / "meshes" / "a.png").write_bytes(b"none")
    robot_shapes(robot_with(package, "../meshes/a.ply"))
    assert not caplog.records and capfd.readouterr().err == ""
