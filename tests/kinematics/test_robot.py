"""RobotModel and Chain against yourdfpy, each other and finite differences."""

import numpy as np
import pytest
import yourdfpy

from app.kinematics import load_robot, robot_names

FORWARD_TOLERANCE = 1e-9  # m and unit vectors: descriptions hold 12 digits
DIFFERENCE_STEP = 1e-6
JACOBIAN_TOLERANCE = 1e-8

SLIDING = """<robot name="gantry">
  <link name="base"/><link name="a"/><link name="b"/><link name="tool0"/>
  <joint name="j1" type="prismatic"><origin xyz="0 0 0.3" rpy="0.2 0 0"/><parent link="base"/><child link="a"/>
    <axis xyz="0 0.6 0.8"/><limit lower="-1" upper="1" velocity="1" effort="1"/></joint>
  <joint name="j2" type="continuous"><origin xyz="0.1 0.2 0" rpy="0 0.4 0"/><parent link="a"/><child link="b"/>
    <axis xyz="0 0 -1"/></joint>
  <joint name="j3" type="fixed"><origin xyz="0.2 0 0.1" rpy="0 0 0.7"/><parent link="b"/><child link="tool0"/></joint>
</robot>"""


SINGLE = """<robot name="turntable">
  <link name="base"/><link name="tool0"/>
  <joint name="j1" type="revolute"><origin xyz="0 0.1 0.3" rpy="0 0.5 0"/><parent link="base"/><child link="tool0"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
</robot>"""
OWN = {"gantry": SLIDING, "turntable": SINGLE}


def poses(robot, count=8, seed=1):
    rng = np.random.default_rng(seed)
    return rng.uniform(np.maximum(robot.lower, -3), np.minimum(robot.upper, 3), (count, robot.joint_count))


@pytest.fixture(params=[*robot_names(), *OWN])
def robot(request, tmp_path):
    if request.param not in OWN:
        return load_robot(request.param)
    path = tmp_path / "own.urdf"
    path.write_text(OWN[request.param])
    return load_robot(path)


def test_forward_kinematics_agrees_with_yourdfpy(robot):
    other = yourdfpy.URDF.load(str(robot.path), load_meshes=False, build_collision_scene_graph=False)
    assert tuple(other.actuated_joint_names) == tuple(j.name for j in robot.joints)
    for q in poses(robot):
        other.update_cfg(q)
        expected = other.get_transform(robot.flange, other.base_link)
        assert np.abs(robot.forward(q).matrix - expected).max() < FORWARD_TOLERANCE


def test_the_chain_of_arrays_agrees_with_pin(robot):
    q = poses(robot)
    frames = robot.chain.frames(q)
    for k, row in enumerate(q):
        expected = robot.forward(row)
        assert np.abs(frames.flange_positions[k] - expected.position).max() < FORWARD_TOLERANCE
        assert np.abs(frames.flange_rotations[k] - expected.rotation).max() < FORWARD_TOLERANCE


def test_the_jacobian_is_the_derivative_of_forward_kinematics(robot):
    for q in poses(robot, 4):
        jacobian = robot.jacobian(q)
        for j in range(robot.joint_count):
            step = np.zeros(robot.joint_count)
            step[j] = DIFFERENCE_STEP
            ahead, behind = robot.forward(q + step), robot.forward(q - step)
            linear = (ahead.position - behind.position) / (2 * DIFFERENCE_STEP)
            turn = ahead.rotation @ behind.rotation.T
            angular = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
            angular /= 4 * DIFFERENCE_STEP
            assert np.abs(jacobian[:3, j] - linear).max() < JACOBIAN_TOLERANCE
            assert np.abs(jacobian[3:, j] - angular).max() < JACOBIAN_TOLERANCE


def test_the_columns_of_the_chain_are_the_jacobian_of_a_carried_point(robot):
    q = poses(robot, 5)
    frames = robot.chain.frames(q)
    columns = robot.chain.jacobian_columns(frames, frames.flange_positions)
    for k, row in enumerate(q):
        assert np.abs(columns[k] - robot.jacobian(row)[:3]).max() < FORWARD_TOLERANCE


def test_shifts_and_turns_of_a_joint_move_everything_behind_it(robot):
    q = poses(robot, 3)
    n = robot.joint_count
    shifts = np.zeros((n + 1, 3))
    shifts[n] = [0.01, -0.02, 0.03]  # of the flange, in its own frame
    plain, moved = robot.chain.frames(q), robot.chain.frames(q, shifts)
    expected = plain.flange_positions + plain.flange_rotations @ shifts[n]
    assert np.abs(moved.flange_positions - expected).max() < FORWARD_TOLERANCE
    assert np.array_equal(moved.joint_positions, plain.joint_positions)


def test_gravity_torques_are_the_slope_of_the_potential_energy(robot):
    if not robot.has_inertials:
        assert np.all(robot.gravity_torques(poses(robot)) == 0)
        return
    chain = robot.chain

    def energy(q):
        frames = chain.frames(q)
        total = 0.0
        for j in range(robot.joint_count):
            cut = load_link(robot, q, j)
            total += chain.masses[j] * 9.81 * (cut[0] + cut[1] @ chain.coms[j])[2]
        assert frames is not None
        return total

    for q in poses(robot, 3):
        torque = robot.gravity_torques(q)
        for j in range(robot.joint_count):
            step = np.zeros(robot.joint_count)
            step[j] = DIFFERENCE_STEP
            slope = (energy(q + step) - energy(q - step)) / (2 * DIFFERENCE_STEP)
            assert torque[j] == pytest.approx(slope, abs=1e-5 * (1 + abs(slope)))


def load_link(robot, q, j):
    """Position and rotation of the frame of joint j after it moved."""
    frames, chain = robot.chain.frames(q), robot.chain
    rotation, position = frames.joint_rotations[0, j], frames.joint_positions[0, j]
    if chain.prismatic[j]:
        return position + frames.axes[0, j] * q[j], rotation
    from app.geometry import exp_so3

    return position, rotation @ exp_so3(chain.axes[j] * q[j])


def test_what_a_chain_keeps_cannot_be_written():
    chain = load_robot("jby50").chain
    with pytest.raises(ValueError, match="read-only"):
        chain.axes[0, 0] = 5.0


def test_many_threads_share_one_model():
    from concurrent.futures import ThreadPoolExecutor

    robot = load_robot("ur10e")
    q = poses(robot, 200)
    expected = [robot.forward(row).matrix for row in q]
    with ThreadPoolExecutor(4) as pool:
        got = list(pool.map(lambda row: robot.forward(row).matrix, q))
    assert all(np.array_equal(a, b) for a, b in zip(got, expected, strict=True))
