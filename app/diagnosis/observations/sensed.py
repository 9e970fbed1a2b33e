"""Measured joint torques, brought to this program's sign: the torque a joint gives to hold the arm."""

from __future__ import annotations

import numpy as np

from app.diagnosis.models.kinematic.gravity import gravity_torques, lumped_masses
from app.diagnosis.thresholds.conventions import OPPOSED
from app.diagnosis.wording import note
from app.kinematics import RobotModel
from app.recordings import Table


def sensed_torques(table: Table, robot: RobotModel, q: np.ndarray, notes: list[str]) -> np.ndarray | None:
    """The torque columns as holding torques (m, n) [Nm]; None where there are none that can be used.

    Controllers differ in what they call positive: the torque the drive gives, or the load it feels. Gravity tells
    which, because it is the same arm in both: where measured and computed gravity torque oppose each other over all
    joints together, the measured one is turned over. Otherwise a soft joint would look as if it rose under its load.
    """
    names = table.numbered("tau")
    if len(names) < robot.joint_count:
        return None
    torque = table.numbers(names[: robot.joint_count])
    if not np.any(torque):
        notes.append(note("torques_zero"))
        return None
    if _opposed(torque, robot, q):
        notes.append(note("torques_turned"))
        return -torque
    return torque


def _opposed(torque: np.ndarray, robot: RobotModel, q: np.ndarray) -> bool:
    chain = robot.chain
    masses, coms = (chain.masses, chain.coms) if robot.has_inertials else lumped_masses(chain)
    gravity = gravity_torques(chain, chain.frames(q), masses, coms)
    size = float(np.linalg.norm(gravity) * np.linalg.norm(torque))
    return size > 0 and float(np.sum(gravity * torque)) / size < OPPOSED
