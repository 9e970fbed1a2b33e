"""The welding arm carries the paper's torch to the paper's six poses."""

import numpy as np
import pytest

from app.geometry import Pose, convention, nearest_rotation
from app.kinematics import CollisionWorld, load_robot, solve_ik
from app.kinematics.solids import solids, tool_shapes

#: Xiong, Ye, Jiang (2012), Table 1: x, y, z [mm], A, B, C [deg], R = Rz(A) Ry(B) Rx(C).
TABLE_1 = np.array(
    [
        [1028.29, 233.29, 1432.98, -156.2, 44.8, -126.6],
        [1118.69, -231.99, 1478.85, 153.6, 19.0, 136.1],
        [1129.45, 25.0, 1564.0, -175.1, 29.4, -175.0],
        [983.98, 0.39, 1502.31, 179.8, 54.3, 180.0],
        [605.47, 0.39, 1502.31, 179.8, 54.3, 180.0],
        [983.98, 0.39, 1122.24, 179.8, 54.3, 180.0],
    ]
)
MARGIN = np.radians(5.0)
LARGEST_MOVE = np.radians(120.0)
TIP_TOLERANCE = 1e-6  # m


def poses():
    zyx = convention("ZYX")
    return [Pose.of(zyx.to_rotation(np.radians(row[3:])), row[:3] / 1e3) for row in TABLE_1]


def recorded():
    robot = load_robot("jby50")
    q, all_q = robot.home, []
    for pose in poses():
        result = solve_ik(robot, pose, q)
        assert result.reached, result
        q = result.q
        all_q.append(q)
    return robot, np.array(all_q)


def test_all_six_poses_are_reached_one_after_the_other_well_inside_the_limits():
    robot, q = recorded()
    assert np.all(robot.within_limits(q, margin=MARGIN))


def test_all_six_poses_share_one_configuration_without_a_wrist_flip():
    robot, q = recorded()
    assert np.all(q[:, 4] > np.radians(5.0))  # axis 5 never passes through straight
    assert np.all(np.abs(np.diff(np.vstack([robot.home, q]), axis=0)) < LARGEST_MOVE)


@pytest.mark.parametrize("index", range(6))
def test_each_pose_is_reached_from_home_alone(index):
    robot, q = recorded()
    result = solve_ik(robot, poses()[index], robot.home)
    assert result.reached
    assert np.allclose(result.q, q[index], atol=1e-4)


def test_nothing_collides_at_the_six_poses():
    robot, q = recorded()
    world = CollisionWorld(robot, tool_shapes=tool_shapes(robot))
    assert all(world.check(row) == [] for row in q)


def test_the_torch_is_the_papers_measured_tool():
    tool = load_robot("jby50").description["tool"]
    pose = Pose.from_quaternion(tool["quaternion_wxyz"], np.array(tool["position_mm"]) / 1e3)
    assert np.allclose(pose.position, [0.1195, 0.0, 0.352])
    printed = nearest_rotation(np.array([[0.584, 0.0, 0.812], [0.0, 1.0, 0.0], [-0.812, 0.0, 0.584]]))
    assert np.allclose(pose.rotation, printed, atol=1e-9)


def test_the_drawn_wire_ends_at_the_tool_point_and_nothing_is_beyond_it():
    robot = load_robot("jby50")
    tool = robot.description["tool"]
    pose = Pose.from_quaternion(tool["quaternion_wxyz"], np.array(tool["position_mm"]) / 1e3)
    points = np.concatenate([s.points for s in solids(tool_shapes(robot))])
    along = pose.inverse().apply(points)  # in the tool frame: Z runs out of the nozzle
    tip = along[np.argmax(along[:, 2])]
    assert tip[2] == pytest.approx(0.0, abs=1e-4)
    assert np.linalg.norm(tip[:2]) < 2e-3
