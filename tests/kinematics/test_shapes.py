"""Shapes and solids: what a description draws, on which body, and the meshes made of it."""

import numpy as np
import pytest

from app.errors import InputError
from app.kinematics import load_robot, robot_names
from app.kinematics.shapes import ball, box, read_shapes, rod
from app.kinematics.solids import faces, outline, robot_shapes, robot_solids, solids, tool_shapes

VOLUME_TOLERANCE = 0.06  # a ring of a dozen or two corners is a little less than a circle
ARM = """<robot name="r"><material name="red"><color rgba="1 0 0 1"/></material>
  <link name="base"><visual><geometry><box size="1 2 3"/></geometry></visual></link>
  <link name="pad"><visual><origin xyz="0 0 1" rpy="0 0 1.5707963267948966"/><geometry><box size="1 2 3"/></geometry>
    <material name="red"/></visual></link>
  <link name="arm"><visual hull="h"><geometry><cylinder radius=".1" length=".4"/></geometry></visual>
    <visual hull="h"><origin xyz="0 0 1"/><geometry><sphere radius=".05"/></geometry></visual>
    <visual collide="no"><geometry><cylinder radius=".2" length=".1" top_radius="0"/></geometry>
    <material name="own"><color rgba="0 1 0 1"/></material></visual></link>
  <link name="hand"><visual><geometry><mesh filename="a.stl"/></geometry></visual></link>
  <joint name="f" type="fixed"><origin xyz="0 0 5"/><parent link="base"/><child link="pad"/></joint>
  <joint name="j" type="revolute"><parent link="pad"/><child link="arm"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" velocity="1" effort="1"/></joint>
  <joint name="g" type="fixed"><parent link="arm"/><child link="hand"/></joint></robot>"""


@pytest.fixture
def shapes(tmp_path):
    path = tmp_path / "r.urdf"
    path.write_text(ARM)
    return read_shapes(path, ("j",))


def volume(points):
    vertices, triangles = faces(points)
    a, b, c = vertices[triangles].transpose(1, 0, 2)
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)  # positive only if wound outwards


def test_links_on_fixed_joints_sit_on_the_body_that_carries_them(shapes):
    assert [(s.link, s.body, s.kind) for s in shapes] == [
        ("base", 0, "box"),
        ("pad", 0, "box"),
        ("arm", 1, "cylinder"),
        ("arm", 1, "sphere"),
        ("arm", 1, "cylinder"),
    ]
    assert np.allclose(shapes[1].T_body_shape.position, [0, 0, 6])
    assert np.allclose(shapes[1].T_body_shape.rotation @ [1, 0, 0], [0, 1, 0])


def test_colours_come_from_the_shared_material_or_from_its_own(shapes):
    assert shapes[1].colour == (1.0, 0.0, 0.0)
    assert shapes[4].colour == (0.0, 1.0, 0.0)
    assert shapes[0].colour != shapes[1].colour


def test_shapes_with_one_hull_become_one_solid_and_drawings_can_be_untouchable(shapes):
    parts = solids(shapes)
    assert [p.link for p in parts] == ["base", "pad", "arm", "arm"]
    assert [p.collides for p in parts] == [True, True, True, False]
    assert parts[2].points[:, 2].min() == pytest.approx(-0.2)
    assert parts[2].points[:, 2].max() == pytest.approx(1.05)


@pytest.mark.parametrize(
    "shape, expected",
    [
        (box((1.0, 2.0, 3.0)), 6.0),
        (ball((0.0, 0, 0), 0.5), np.pi / 6),
        (rod((0.0, 0, 0), (0, 0, 2.0), 0.3), np.pi * 0.18),
        (rod((0.0, 0, 0), (1.0, 1.0, 0), 0.3, 0.1), np.pi * np.sqrt(2) * (0.09 + 0.03 + 0.01) / 3),
        (rod((0.0, 0, 0), (0, 0, 1.0), 0.3, 0.0), np.pi * 0.03),
    ],
    ids=["box", "ball", "rod", "frustum", "cone"],
)
def test_a_mesh_is_closed_wound_outwards_and_has_the_volume_of_its_shape(shape, expected):
    assert volume(outline(shape)) == pytest.approx(expected, rel=VOLUME_TOLERANCE)
    assert volume(outline(shape, chamfer=0.0)) == pytest.approx(expected, rel=VOLUME_TOLERANCE)


def test_a_sharp_box_is_exact():
    points = outline(box((1.0, 2.0, 3.0)), chamfer=0.0)
    assert np.array_equal(points.max(axis=0), [0.5, 1.0, 1.5])
    assert volume(points) == pytest.approx(6.0)


def test_a_cone_ends_in_its_point():
    cone = rod((0.0, 0, 0), (0, 0, 1.0), 0.3, 0.0)
    tip = cone.T_body_shape.apply(outline(cone, chamfer=0.0))
    assert tip[np.argmax(tip[:, 2])] == pytest.approx([0, 0, 1.0], abs=2e-4)


def test_sharp_edges_are_parted_and_round_sides_are_not():
    vertices, _ = faces(outline(box((1.0, 1.0, 1.0)), chamfer=0.0))
    assert len(vertices) == 24  # each of eight corners once for each of its three sides
    points = outline(rod((0.0, 0, 0), (0, 0, 1.0), 0.3), chamfer=0.0)
    vertices, _ = faces(points)
    assert len(vertices) == 2 * len(points)  # each rim once for the side and once for its lid


@pytest.mark.parametrize("name", robot_names())
def test_a_robot_is_light_enough_for_a_browser_without_a_graphics_card(name):
    robot = load_robot(name)
    parts = robot_solids(robot) + solids(tool_shapes(robot))
    assert sum(len(faces(p.points)[1]) for p in parts) < 12500
    assert len({(p.body, p.colour) for p in parts}) < 40  # scene nodes


def test_a_description_without_shapes_becomes_a_stick_figure(tmp_path):
    path = tmp_path / "bare.urdf"
    path.write_text(
        ARM.replace("box size", "nothing size").replace("cylinder", "mesh").replace("sphere", "mesh")
    )
    shapes = robot_shapes(load_robot(path))
    assert {s.body for s in shapes} == {0, 1}
    assert any(s.link == "joint 1" for s in shapes)


@pytest.mark.parametrize(
    "wrong", ['<box size="1 2"/>', '<box size="a b c"/>', '<cylinder radius="1"/>', "<sphere/>"]
)
def test_a_shape_without_its_size_is_refused(tmp_path, wrong):
    path = tmp_path / "r.urdf"
    path.write_text(ARM.replace('<box size="1 2 3"/>', wrong, 1))
    with pytest.raises(InputError, match="of link 'base'"):
        read_shapes(path, ("j",))
