"""The constant step from the frame found to the maker's own base frame, from the robot's description.

The patent's origin lies at the height of axis 2, the maker's usually on the mounting face. The step comes from
building the patent's frame out of the description's own two axes.
"""

from __future__ import annotations

import numpy as np

from app.calibration.base.frame import Axes, base_frames
from app.calibration.base.result import BaseCalibration, MakerFrame
from app.geometry import Pose, rot_z
from app.geometry.line import PARALLEL
from app.kinematics import RobotModel

_ON_AXIS = 0.02  # m: a flange this near to axis 1 says nothing about the front


def nominal_frame(robot: RobotModel) -> tuple[Pose, float, float] | None:
    """The patent's frame in the description's base, with offset [m] and angle [rad] of axes 1 and 2.

    None where the first two joints do not turn, or turn about parallel axes.
    """
    if robot.joint_count < 2 or bool(robot.chain.prismatic[:2].any()):
        return None
    frames = robot.chain.frames(np.zeros((1, robot.joint_count)))
    z, d2 = frames.axes[0, 0], frames.axes[0, 1]
    p1, p2 = frames.joint_positions[0, 0], frames.joint_positions[0, 1]
    if float(np.linalg.norm(np.cross(z, d2))) < max(PARALLEL, 1e-6):
        return None
    z = z if z[2] >= 0 else -z  # the patent: from the mounting face to the body
    d2 = d2 if d2[1] >= 0 else -d2  # positive about Y, whatever way the maker counts
    flange = frames.flange_positions[0] - p1
    flange = flange - (flange @ z) * z
    forward = flange if np.linalg.norm(flange) > _ON_AXIS else np.array([1.0, 0.0, 0.0])
    f = base_frames(_line(p1, z), _line(p2, d2), p1 + 10.0 * forward, unclear=_ON_AXIS)
    return Pose(f.matrices), float(f.offset), float(f.angle)


def _line(point: np.ndarray, direction: np.ndarray) -> Axes:
    helper = np.eye(3)[np.argmin(np.abs(direction))]
    e1 = np.cross(helper, direction)
    e1 = e1 / np.linalg.norm(e1)
    return Axes(point, np.stack([e1, np.cross(direction, e1), direction]), np.zeros((4, 4)))


def maker_frame(base: BaseCalibration, robot: RobotModel) -> MakerFrame | None:
    """Where the description's base link stands; None where its axes 1 and 2 have no such frame.

    Where axis 2 was turned with joint 1 away from zero, that angle is taken out first.
    """
    nominal = nominal_frame(robot)
    if nominal is None:
        return None
    T_maker_base, offset, angle = nominal
    step = T_maker_base.inverse()
    turned = base.zero.angle if base.zero is not None and base.zero.known else 0.0
    found = base.T_tracker_base @ Pose.of(rot_z(-turned)) @ step
    name = robot.title if robot.description else robot.model.name
    return MakerFrame(name, step, found, offset, angle, float(T_maker_base.position[2]))
