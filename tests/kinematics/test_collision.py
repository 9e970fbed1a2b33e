"""Collision: what touches is named, what belongs together is not, distances are those of the solids."""

import numpy as np
import pytest

from app.geometry import Pose
from app.kinematics import CollisionWorld, load_robot, robot_names, solve_ik
from app.kinematics.shapes import ball, box, floor, rod
from app.kinematics.solids import tool_shapes

DISTANCE_TOLERANCE = 1e-5  # m: GJK's own
CHAMFER_TOLERANCE = 0.013  # m: what a drawn edge loses

#: One metre along X, then a ball at its end; the joint turns it about Z.
BOOM = """<robot name="boom"><link name="base"/>
  <link name="boom_arm"><visual><origin xyz="1 0 0"/><geometry><sphere radius="0.1"/></geometry></visual></link>
  <joint name="j" type="revolute"><parent link="base"/><child link="boom_arm"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" velocity="1" effort="1"/></joint></robot>"""


@pytest.fixture
def boom(tmp_path):
    path = tmp_path / "boom.urdf"
    path.write_text(BOOM)
    return load_robot(path)


@pytest.mark.parametrize("name", robot_names())
def test_every_robot_is_free_at_home_and_has_pairs_to_look_at(name):
    robot = load_robot(name)
    world = CollisionWorld(robot, tool_shapes=tool_shapes(robot))
    assert world.pairs
    assert world.check(robot.home) == []
    assert not world.collides(robot.home)
    assert world.distance(robot.home).distance > 0


def test_the_distance_to_a_ball_is_that_of_two_balls(boom):
    for gap in (0.5, 0.05, 0.0005):
        world = CollisionWorld(boom, obstacles=[ball((0.0, 1.2 + gap, 0.0), 0.1, link="post")])
        nearest = world.distance(np.array([np.pi / 2]))
        assert (nearest.a, nearest.b) == ("boom arm", "post")
        assert nearest.distance == pytest.approx(gap, abs=5e-4)  # the drawn ball is a polyhedron


def test_an_overlap_has_a_negative_distance_and_says_who(boom):
    world = CollisionWorld(boom, obstacles=[box((0.2, 0.2, 0.2), (0.0, 1.0, 0.0), link="fence_post")])
    assert world.check(np.array([0.0])) == []
    (pair,) = world.check(np.array([np.pi / 2]))
    assert pair.distance < 0
    assert pair.sentence() == "boom arm touches fence post"


def test_what_stands_in_the_hollow_of_a_link_does_not_touch_it(tmp_path):
    path = tmp_path / "angle.urdf"  # an L: a bar along X and a post along Z at its end
    path.write_text(
        BOOM.replace(
            '<visual><origin xyz="1 0 0"/><geometry><sphere radius="0.1"/></geometry></visual>',
            """<visual><origin xyz="0.5 0 0"/><geometry><box size="1 0.1 0.1"/></geometry></visual>
               <visual><origin xyz="0.95 0 0.5"/><geometry><box size="0.1 0.1 1"/></geometry></visual>""",
        )
    )
    robot = load_robot(path)
    inside = ball((0.75, 0.0, 0.2), 0.05, link="post")
    world = CollisionWorld(robot, obstacles=[inside])
    assert world.check(np.zeros(1)) == [] and not world.collides(np.zeros(1))
    assert world.distance(np.zeros(1)).distance == pytest.approx(0.1, abs=2e-3)
    touching = CollisionWorld(robot, obstacles=[ball((0.87, 0.0, 0.2), 0.05, link="post")])
    assert touching.collides(np.zeros(1)) and touching.check(np.zeros(1))[0].distance < 0


def test_an_arm_hanging_beside_its_pedestal_is_free():
    robot = load_robot("ur10e")
    q = robot.home.copy()
    q[1:4] = 1.2, 0.2, -1.4  # upper arm pointing down past the base, as on a pedestal
    assert CollisionWorld(robot).check(q) == []


def test_a_margin_warns_before_contact(boom):
    post = ball((0.0, 1.23, 0.0), 0.1, link="post")
    q = np.array([np.pi / 2])
    assert CollisionWorld(boom, obstacles=[post]).check(q) == []
    (pair,) = CollisionWorld(boom, obstacles=[post], margin=0.05).check(q)
    assert pair.distance == pytest.approx(0.03, abs=5e-4)


@pytest.mark.parametrize("height", [-0.5, -0.15, -0.05])
def test_a_floor_is_as_far_as_its_height_says(boom, height):
    world = CollisionWorld(boom, obstacles=[floor(height, link="table")])
    nearest = world.distance(np.array([0.3]))
    assert nearest.b == "table"
    assert nearest.distance == pytest.approx(-height - 0.1, abs=1e-3)
    assert bool(world.check(np.array([0.3]))) == (height > -0.1)


def test_the_nearest_pair_is_the_least_of_all_pairs():
    robot = load_robot("jby50")
    things = [
        floor(-0.2),
        box((0.6, 0.6, 0.4), (1.1, 0, 0.2), link="table"),
        rod((1.1, 0, 0.4), (1.1, 0, 0.6), 0.02, 0.0, link="spike"),
    ]
    world = CollisionWorld(robot, tool_shapes=tool_shapes(robot), obstacles=things)
    rng = np.random.default_rng(5)
    free = 0
    for _ in range(40):
        q = robot.home + rng.normal(0, 0.25, 6)
        expected = world._distances(q)
        got = world.distance(q)
        if expected.min() > 0:
            free += 1
            assert got.distance == pytest.approx(expected.min(), abs=DISTANCE_TOLERANCE)
        assert bool(world.check(q)) == (expected.min() <= 0) or abs(expected.min()) < DISTANCE_TOLERANCE
        assert world.collides(q) == bool(world.check(q))
    assert free > 5


def touching_world(robot, tool, **options):
    """A spike whose point is where the tool point is at home."""
    tip = (robot.forward(robot.home) @ tool).position
    spike = rod(tip - np.array([0.0, 0.0, 0.2]), tip, 0.01, 0.0, link="spike")
    return CollisionWorld(robot, tool_shapes=tool_shapes(robot), obstacles=[spike], **options)


def torch(robot):
    info = robot.description["tool"]
    return Pose.from_quaternion(info["quaternion_wxyz"], np.array(info["position_mm"]) / 1e3)


def test_the_tip_may_touch_the_spike_but_the_nozzle_may_not():
    robot = load_robot("jby50")
    tool = torch(robot)
    world = touching_world(robot, tool)
    assert world.check(robot.home) == []
    strict = touching_world(robot, tool, allowed=())
    assert [(p.a, p.b) for p in strict.check(robot.home)] == [("tool tip", "spike")]
    start = robot.forward(robot.home) @ tool
    deeper = Pose.of(start.rotation, start.position - np.array([0.0, 0.0, 0.03]))
    q = solve_ik(robot, deeper, robot.home, T_flange_tool=tool).q
    assert ("torch", "spike") in [(p.a, p.b) for p in world.check(q)]


def test_neighbours_are_never_reported_but_a_link_further_on_is():
    robot = load_robot("jby50")
    world = CollisionWorld(robot)
    assert not {("base", "carousel"), ("carousel", "lower arm"), ("lower arm", "upper arm")} & set(
        world.pairs
    )
    folded = robot.home.copy()
    folded[1:3] = np.radians([60.0, 80.0])  # lower arm forwards, upper arm hanging back under it
    folded[4] = np.radians(100.0)
    touching = [(p.a, p.b) for p in world.check(folded)]
    assert any(a in ("base", "carousel", "lower arm") for a, _ in touching), touching


def test_an_obstacle_at_the_flange_touches_the_wrist():
    robot = load_robot("jby50")
    here = robot.forward(robot.home).position
    world = CollisionWorld(robot, obstacles=[box((0.1, 0.1, 0.1), here, link="clamp")])
    assert ("tool flange", "clamp") in [(p.a, p.b) for p in world.check(robot.home)]


def test_a_base_on_its_table_is_no_collision():
    robot = load_robot("ur10e")
    world = CollisionWorld(robot, obstacles=[box((0.5, 0.5, 0.2), (0.0, 0.0, -0.1), link="table")])
    assert ("base", "table") not in world.pairs
    assert world.check(robot.home) == []


def test_an_arm_without_drawing_is_a_stick_figure_that_collides(tmp_path):
    path = tmp_path / "bare.urdf"
    path.write_text(
        """<robot name="bare"><link name="base"/><link name="a"/><link name="b"/><link name="tool0"/>
        <joint name="j1" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/>
          <limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
        <joint name="j2" type="revolute"><origin xyz="0.5 0 0"/><parent link="a"/><child link="b"/><axis xyz="0 1 0"/>
          <limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
        <joint name="t" type="fixed"><origin xyz="0.5 0 0"/><parent link="b"/><child link="tool0"/></joint></robot>"""
    )
    robot = load_robot(path)
    world = CollisionWorld(robot, obstacles=[ball((0.9, 0.0, 0.0), 0.05, link="post")])
    assert {p.b for p in world.check(np.zeros(2))} == {"post"}
    assert world.check(np.array([1.5, 0.0])) == []
