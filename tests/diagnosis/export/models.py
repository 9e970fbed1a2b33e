"""A model with everything in it that simulators have a place for, and the torques it gives by Teachframe's own laws."""

import numpy as np

from app.diagnosis.model import ModelEffect, SavedModel
from app.kinematics.dynamics import flange_to_last_link, inverse_dynamics, point_mass
from app.kinematics.regressor import PER_LINK, torque_regressor
from app.kinematics.robot import GRAVITY

VISCOUS, COULOMB, ROTOR = (
    (12.0, 9.0, 7.0, 2.5, 2.0, 1.5),
    (8.0, 10.0, 6.0, 2.0, 1.8, 1.2),
    (1.1, 1.3, 0.7, 0.2, 0.2, 0.1),
)
QUADRATIC, SPRING, OFFSET = 1.7, 25.0, 3.5
LOAD, AT = 2.4, np.array([0.02, -0.03, 0.11])
GRAVITY_LEANING = np.array([0.4, -0.3, -9.79])
CHANGE = np.array([0.3, 0.01, -0.02, 0.03, 0.004, 0.0005, 0.003, -0.0004, 0.0002, 0.005])
NAMES = ("mass", "mx", "my", "mz", "ixx", "ixy", "iyy", "ixz", "iyz", "izz")


def effect(key, where, **values):
    return ModelEffect(key, where, values)


def rigid_laws():
    """Laws that every one of the targets has."""
    return (
        effect("payload", {"body": "tool"}, mass=LOAD, com_x=AT[0], com_y=AT[1], com_z=AT[2]),
        ModelEffect("link_inertia", {"link": 3}, dict(zip(NAMES, map(float, CHANGE), strict=True))),
        *(
            effect("viscous_friction", {"joint": j, "driver": "speed"}, viscous=v)
            for j, v in enumerate(VISCOUS, 1)
        ),
    )


def laws():
    """Laws that MuJoCo has."""
    return (
        *rigid_laws(),
        effect("gravity_direction", {"body": "base"}, gx=0.4, gy=-0.3, gz=-9.79),
        effect("quadratic_friction", {"joint": 1, "driver": "speed"}, quadratic=QUADRATIC),
        effect("joint_spring", {"joint": 2, "driver": "own_angle"}, stiffness=SPRING, offset=OFFSET),
        *(effect("rotor_inertia", {"joint": j}, inertia=v) for j, v in enumerate(ROTOR, 1)),
    )


def dry():
    return tuple(
        effect("coulomb_friction", {"joint": j, "driver": "speed"}, coulomb=v)
        for j, v in enumerate(COULOMB, 1)
    )


def model(robot, effects):
    return SavedModel("motion", robot.name, tuple(effects), source="log.csv")


def trajectory(robot, samples=400, seconds=8.0):
    """q, qd, qdd (m, n): slow waves of several frequencies in every joint, as an identification run has them."""
    t = np.linspace(0.0, seconds, samples)
    q, qd, qdd = (np.zeros((samples, robot.joint_count)) for _ in range(3))
    rng = np.random.default_rng(4)
    for j in range(robot.joint_count):
        for wave in (0.3, 0.7, 1.1):
            size, phase, w = (
                rng.uniform(0.1, 0.3),
                rng.uniform(0, 6.0),
                2 * np.pi * wave * rng.uniform(0.6, 1.0),
            )
            q[:, j] += size * np.sin(w * t + phase)
            qd[:, j] += size * w * np.cos(w * t + phase)
            qdd[:, j] -= size * w**2 * np.sin(w * t + phase)
    return np.clip(robot.home, robot.lower + 1.0, robot.upper - 1.0) + q, qd, qdd


def rigid_torque(robot, q, qd, qdd, gravity=GRAVITY):
    """(m, n) [Nm] of the description with the load and the changed link, and viscous friction."""
    change = np.zeros(PER_LINK * robot.joint_count)
    change[2 * PER_LINK : 3 * PER_LINK] = CHANGE
    change[-PER_LINK:] += flange_to_last_link(robot) @ point_mass(LOAD, AT)
    Y = torque_regressor(robot, q, qd, qdd, gravity=gravity)
    added = np.einsum("mjk,k->mj", Y, change)
    return inverse_dynamics(robot, q, qd, qdd, gravity=gravity) + added + np.array(VISCOUS) * qd


def full_torque(robot, q, qd, qdd):
    """The same with everything of `laws`."""
    torque = rigid_torque(robot, q, qd, qdd, GRAVITY_LEANING)
    torque[:, 0] += QUADRATIC * qd[:, 0] * np.abs(qd[:, 0])
    torque[:, 1] += SPRING * q[:, 1] + OFFSET
    return torque + np.array(ROTOR) * qdd
