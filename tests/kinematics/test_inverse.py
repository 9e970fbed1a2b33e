"""Inverse kinematics: gets there, keeps the last good pose, says what stopped it."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.geometry import Pose, angle_between, exp_so3
from app.kinematics import load_robot, robot_names, solve_ik

POSITION_TOLERANCE = 2e-6  # m: the solver's own 1e-6, and rounding
ROTATION_TOLERANCE = 2e-6  # rad

#: Three joints about x, y, x that meet in one point: a wrist, and nothing else.
WRIST = """<robot name="wrist">
  <link name="base"/><link name="a"/><link name="b"/><link name="tool0"/>
  <joint name="j1" type="revolute"><parent link="base"/><child link="a"/><axis xyz="1 0 0"/>
    <limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
  <joint name="j2" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" velocity="1" effort="1"/></joint>
  <joint name="j3" type="revolute"><parent link="b"/><child link="tool0"/><axis xyz="1 0 0"/>
    <limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
</robot>"""


@pytest.mark.parametrize("name", robot_names())
def test_a_reachable_pose_near_the_start_is_reached(name):
    robot = load_robot(name)
    rng = np.random.default_rng(3)
    for _ in range(20):
        goal = np.clip(robot.home + rng.normal(0, 0.15, robot.joint_count), robot.lower, robot.upper)
        target = robot.forward(goal)
        result = solve_ik(robot, target, robot.home)
        assert result.reached, (goal, result)
        assert robot.within_limits(result.q)
        got = robot.forward(result.q)
        assert np.linalg.norm(got.position - target.position) < POSITION_TOLERANCE
        assert angle_between(got.rotation, target.rotation) < ROTATION_TOLERANCE


def test_the_tool_is_what_is_aimed():
    robot = load_robot("jby50")
    tool = Pose.of(exp_so3(np.array([0.1, 0.9, -0.2])), np.array([0.1195, 0.0, 0.352]))
    start = robot.forward(robot.home) @ tool
    target = Pose.of(
        exp_so3(np.array([0.05, -0.1, 0.2])) @ start.rotation, start.position + np.array([0.05, 0.1, -0.1])
    )
    result = solve_ik(robot, target, robot.home, T_flange_tool=tool)
    assert result.reached
    got = robot.forward(result.q) @ tool
    assert np.linalg.norm(got.position - target.position) < POSITION_TOLERANCE


def test_a_start_at_the_target_takes_no_step():
    robot = load_robot("ur10e")
    result = solve_ik(robot, robot.forward(robot.home), robot.home)
    assert result.reached and result.steps == 0
    assert np.array_equal(result.q, robot.home)


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**31))
def test_the_result_is_inside_the_limits_and_never_worse_than_the_start(seed):
    robot = load_robot("jby50")
    rng = np.random.default_rng(seed)
    target = Pose.of(exp_so3(rng.normal(0, 1.5, 3)), rng.uniform([-2.5, -2.5, -0.5], [2.5, 2.5, 3.0]))
    start = rng.uniform(robot.lower, robot.upper)
    result = solve_ik(robot, target, start)

    def cost(q):
        got = robot.forward(q)
        turn = angle_between(got.rotation, target.rotation)
        return np.linalg.norm(got.position - target.position) ** 2 + (0.3 * turn) ** 2

    assert robot.within_limits(result.q)
    assert cost(result.q) <= cost(start) * (1 + 1e-9)
    assert result.reached == (result.position_error <= 1e-6 and result.rotation_error <= 1e-6)


def test_a_joint_that_would_have_to_pass_its_limit_is_named():
    robot = load_robot("jby50")
    start = robot.home.copy()
    start[0] = robot.upper[0] - 0.05
    beyond = start.copy()
    beyond[0] = robot.upper[0] + 0.10
    result = solve_ik(robot, robot.forward(beyond), start)
    assert result.reason == "limit"
    assert result.joints == (1,)
    assert result.sentence() == "axis 1 at its limit"
    assert result.q[0] == pytest.approx(robot.upper[0])


def test_a_straight_wrist_that_must_turn_sideways_is_called_singular(tmp_path):
    path = tmp_path / "wrist.urdf"
    path.write_text(WRIST)
    robot = load_robot(path)
    sideways = Pose.of(exp_so3(np.array([0.0, 0.0, 0.5])))
    result = solve_ik(robot, sideways, np.zeros(3))
    assert result.reason == "singular"
    assert np.array_equal(result.q, np.zeros(3))
    assert solve_ik(robot, sideways, np.array([1.0, 0.3, -1.0])).reached  # another way round does it


@pytest.mark.parametrize("distance", [1.0, 2.0, 50.0])
def test_a_point_beyond_the_arm_is_out_of_reach_and_the_arm_keeps_still_or_nearer(distance):
    robot = load_robot("jby50")
    here = robot.forward(robot.home)
    target = Pose.of(here.rotation, here.position + np.array([1.5 + distance, 0.0, 0.0]))
    result = solve_ik(robot, target, robot.home)
    assert result.reason == "out_of_reach"
    assert result.joints == ()
    assert result.sentence() == "out of reach"
    assert result.position_error <= np.linalg.norm(target.position - here.position)


def test_the_middle_of_the_base_is_out_of_reach_though_it_is_near(tmp_path):
    path = tmp_path / "two.urdf"  # two links of 0.6 and 0.2 m in a plane: nothing nearer than 0.4 m
    path.write_text(
        """<robot name="two"><link name="base"/><link name="a"/><link name="b"/><link name="tool0"/>
        <joint name="j1" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/>
          <limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
        <joint name="j2" type="revolute"><origin xyz="0.6 0 0"/><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
          <limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
        <joint name="t" type="fixed"><origin xyz="0.2 0 0"/><parent link="b"/><child link="tool0"/></joint></robot>"""
    )
    robot = load_robot(path)
    result = solve_ik(robot, Pose.of(None, np.array([0.1, 0.1, 0.0])), np.array([0.3, 1.0]))
    assert result.reason == "out_of_reach"


@pytest.mark.parametrize("name", robot_names())
def test_what_some_joint_angles_reach_is_never_called_out_of_reach(name):
    robot = load_robot(name)
    rng = np.random.default_rng(1)
    for _ in range(30):
        goal = rng.uniform(np.maximum(robot.lower, -3), np.minimum(robot.upper, 3))
        assert solve_ik(robot, robot.forward(goal), robot.home).reason != "out_of_reach", goal


def test_without_an_explanation_the_pose_is_the_same_and_a_limit_is_still_named():
    robot = load_robot("jby50")
    start, beyond = robot.home.copy(), robot.home.copy()
    start[0], beyond[0] = robot.upper[0] - 0.05, robot.upper[0] + 0.10
    target = robot.forward(beyond)
    full, quick = (solve_ik(robot, target, start, explain=explain) for explain in (True, False))
    assert np.array_equal(full.q, quick.q)
    assert quick.reason == "limit" and quick.joints == (1,)
    here = robot.forward(robot.home)
    far = Pose.of(here.rotation, here.position + np.array([5.0, 0.0, 0.0]))
    assert solve_ik(robot, far, robot.home, explain=False).reason == "out_of_reach"


def test_a_chain_of_small_drags_follows_without_a_jump():
    robot = load_robot("jby50")
    start = robot.forward(robot.home)
    q, largest = robot.home, 0.0
    for k in range(200):
        target = Pose.of(start.rotation, start.position + np.array([0.0, 0.002 * k, 0.0]))
        result = solve_ik(robot, target, q)
        assert result.reached
        largest, q = max(largest, float(np.abs(result.q - q).max())), result.q
    assert largest < 0.02  # rad for 2 mm at about 1 m
