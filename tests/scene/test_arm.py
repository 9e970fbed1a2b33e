"""The drawn arm stands where the computed arm stands, and moving it sends joint turns and nothing else."""

import numpy as np
import pytest
import viser

from app.geometry import Pose, rotation_from_quaternion
from app.kinematics import load_robot, robot_names
from app.kinematics.shapes import box
from app.scene.arm import ArmView, draw_shapes
from app.simulation.held import pointer_shapes

DRAWN_TOLERANCE = 1e-9  # m and unit vectors

SLIDING = """<robot name="gantry"><link name="base"/><link name="a"/><link name="tool0"/>
  <joint name="j1" type="prismatic"><origin xyz="0 0 0.3" rpy="0.2 0 0"/><parent link="base"/><child link="a"/>
    <axis xyz="0 0.6 0.8"/><limit lower="-1" upper="1" velocity="1" effort="1"/></joint>
  <joint name="j2" type="revolute"><origin xyz="0.5 0.2 0" rpy="0 0.4 0"/><parent link="a"/><child link="tool0"/>
    <axis xyz="0 0 -1"/><limit lower="-1" upper="1" velocity="1" effort="1"/></joint></robot>"""


@pytest.fixture(scope="module")
def server():
    running = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    yield running
    running.stop()


def drawn_flange(view):
    """T_root_flange from the frames that the browser is given, by their names."""
    nodes = view._joints
    pose = Pose.identity()
    for handle in [*nodes, view._flange]:
        pose = pose @ Pose.of(rotation_from_quaternion(np.array(handle.wxyz)), np.array(handle.position))
    return pose


@pytest.mark.parametrize("name", [*robot_names(), "gantry"])
def test_the_drawn_flange_is_where_forward_kinematics_puts_it(server, tmp_path, name):
    if name == "gantry":
        (tmp_path / "gantry.urdf").write_text(SLIDING)
        robot = load_robot(tmp_path / "gantry.urdf")
    else:
        robot = load_robot(name)
    view = ArmView(server.scene, robot, f"/{name}")
    assert view.flange_path.startswith(f"/{name}/joint1/joint2")
    rng = np.random.default_rng(0)
    for q in [
        robot.home,
        *rng.uniform(np.maximum(robot.lower, -3), np.minimum(robot.upper, 3), (5, robot.joint_count)),
    ]:
        view.set(q)
        assert np.abs(drawn_flange(view).matrix - robot.forward(q).matrix).max() < DRAWN_TOLERANCE
    view.remove()


def test_a_move_sends_one_message_for_each_joint_that_moved(server, monkeypatch):
    robot = load_robot("ur10e")
    view = ArmView(server.scene, robot, "/counted")
    sent = []
    monkeypatch.setattr(view._joints[0]._impl.api._websock_interface, "queue_message", sent.append)
    q = robot.home.copy()
    view.set(q)
    assert sent == []
    q[2] += 0.1
    view.set(q)
    assert len(sent) == 1
    view.set(q + 0.1)
    assert len(sent) == 1 + robot.joint_count
    monkeypatch.undo()
    view.remove()


def test_an_arm_that_is_hidden_or_removed_can_be_drawn_again(server):
    robot = load_robot("irb120")
    view = ArmView(server.scene, robot, "/again", ghost=True)
    view.visible = False
    assert not view.visible
    view.visible = True
    assert view.visible
    view.remove()
    ArmView(server.scene, robot, "/again").remove()


def test_a_pointer_ends_at_the_tool_point_and_a_bare_flange_has_none():
    tip = np.array([0.05, -0.02, 0.25])
    parts = pointer_shapes(Pose.of(None, tip))
    from app.kinematics.solids import solids

    points = np.concatenate([s.points for s in solids(parts)])
    assert np.min(np.linalg.norm(points - tip, axis=1)) < 1e-3
    assert pointer_shapes(Pose.identity()) == ()


def test_shapes_that_stand_still_are_drawn_under_their_node(server):
    frame = draw_shapes(server.scene, "/cell", [box((1.0, 1.0, 0.1), link="table")])
    frame.visible = False
    frame.remove()
