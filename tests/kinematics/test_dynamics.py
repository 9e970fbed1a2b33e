"""Columns of the rigid-body torque agree with inverse dynamics, whatever is varied."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
import pytest

from app.kinematics import load_robot
from app.kinematics.dynamics import (
    flange_to_last_link,
    gravity_and_force_columns,
    inertial_parameters,
    inverse_dynamics,
    point_mass,
    torque_regressor,
)

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


def test_gravity_columns_hold_the_arm_under_any_gravity(case):
    robot, q, qd, _ = case
    columns, _ = gravity_and_force_columns(robot, q)
    gravity = np.array([0.5, 1.5, -9.0])
    np.testing.assert_allclose(
        columns @ gravity, inverse_dynamics(robot, q, 0 * qd, 0 * qd, gravity=gravity), atol=SAME
    )


def test_a_force_on_the_flange_is_the_transposed_jacobian(case):
    robot, q, _, _ = case
    _, columns = gravity_and_force_columns(robot, q)
    force = np.array([3.0, -4.0, 5.0])
    for row, pose in zip(columns, q, strict=True):
        np.testing.assert_allclose(row @ force, robot.jacobian(pose)[:3].T @ force, atol=SAME)


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
