"""Columns of the rigid-body torque agree with inverse dynamics, whatever is varied."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
import pytest

from app.kinematics import load_robot
from app.kinematics.dynamics import (
    flange_to_last_link,
    gravity_and_wrench_columns,
    inertial_parameters,
    inverse_dynamics,
    point_mass,
)
from app.kinematics.regressor import torque_regressor

SAME = 1e-9


@pytest.fixture(params=["ur10e", "iiwa14", "jby50"])
def case(request):
    robot = load_robot(request.param)
    q, qd, qdd = np.random.default_rng(4).normal(size=(3, 25, robot.joint_count))
    return robot, q, qd, qdd


def test_the_regressor_times_the_description_is_inverse_dynamics(case):
    robot, q, qd, qdd = case
    for gravity in ([0.0, 0.0, -9.81], [1.0, -2.0, -9.0]):
        gravity = np.array(gravity)
        torque = torque_regressor(robot, q, qd, qdd, gravity=gravity) @ inertial_parameters(robot)
        np.testing.assert_allclose(torque, inverse_dynamics(robot, q, qd, qdd, gravity=gravity), atol=SAME)


@pytest.mark.parametrize("name", ["ur10e", "iiwa14", "jby50", "scara"])
def test_the_regressor_is_pins_own_column_by_column(name, tmp_path):
    robot = _scara(tmp_path) if name == "scara" else load_robot(name)
    q, qd, qdd = np.random.default_rng(5).normal(size=(3, 9, robot.joint_count))
    data = robot.model.createData()
    theirs = [
        pin.computeJointTorqueRegressor(robot.model, data, a, b, c).copy()
        for a, b, c in zip(q, qd, qdd, strict=True)
    ]
    np.testing.assert_allclose(torque_regressor(robot, q, qd, qdd), theirs, atol=SAME)


def _scara(folder):
    """Two turning joints, a sliding one and a turning one; axes not all along z, frames turned."""
    joints = [
        ("revolute", "0 0 0.4", "0 0 0.3", "0 0 1"),
        ("revolute", "0.3 0 0", "0.2 0 0", "0 0.6 0.8"),
        ("prismatic", "0.25 0.02 0", "0 0.4 0", "0 0 -1"),
        ("revolute", "0 0 -0.1", "0 0 0", "0 0 1"),
    ]
    text = "<link name='l0'/>"
    for k, (kind, xyz, rpy, axis) in enumerate(joints):
        text += (
            f"<link name='l{k + 1}'><inertial><origin xyz='0.1 0.02 0.0{k}'/><mass value='{3 - 0.5 * k}'/>"
            "<inertia ixx='0.02' ixy='0.001' ixz='0' iyy='0.03' iyz='0.002' izz='0.025'/></inertial></link>"
            f"<joint name='j{k}' type='{kind}'><parent link='l{k}'/><child link='l{k + 1}'/>"
            f"<origin xyz='{xyz}' rpy='{rpy}'/><axis xyz='{axis}'/>"
            "<limit lower='-2' upper='2' velocity='3' effort='50'/></joint>"
        )
    path = folder / "scara.urdf"
    path.write_text(f"<robot name='scara'>{text}</robot>")
    return load_robot(str(path))


def test_gravity_columns_hold_the_arm_under_any_gravity(case):
    robot, q, qd, _ = case
    columns, _ = gravity_and_wrench_columns(robot, q)
    gravity = np.array([0.5, 1.5, -9.0])
    np.testing.assert_allclose(
        columns @ gravity, inverse_dynamics(robot, q, 0 * qd, 0 * qd, gravity=gravity), atol=SAME
    )


def test_a_wrench_at_the_flange_is_the_transposed_jacobian(case):
    robot, q, _, _ = case
    _, columns = gravity_and_wrench_columns(robot, q)
    wrench = np.array([3.0, -4.0, 5.0, 0.7, -0.2, 0.4])
    for row, pose in zip(columns, q, strict=True):
        np.testing.assert_allclose(row @ wrench, robot.jacobian(pose).T @ wrench, atol=SAME)


def test_a_mass_on_the_flange_is_a_heavier_last_link(case):
    robot, q, qd, qdd = case
    load, at = 2.5, np.array([0.05, -0.02, 0.1])
    columns = torque_regressor(robot, q, qd, qdd)[:, :, -10:] @ flange_to_last_link(robot)
    model = pin.Model(robot.model)
    body = pin.Inertia(load, at, np.zeros((3, 3)))
    last = robot.joint_count
    model.inertias[last] = model.inertias[last] + model.frames[robot.flange_id].placement.act(body)
    data = model.createData()
    heavier = np.array([pin.rnea(model, data, *row).copy() for row in zip(q, qd, qdd, strict=True)])
    np.testing.assert_allclose(
        columns @ point_mass(load, at), heavier - inverse_dynamics(robot, q, qd, qdd), atol=SAME
    )
