"""URDF's <origin> and poses, one from the other: rpy turns about fixed X, then Y, then Z."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET

import numpy as np

from app.geometry.pose import Pose
from app.geometry.rotation import rot_x, rot_y, rot_z

_LEVEL = 1e-9  # of cos(pitch), below which roll and yaw turn about one axis


def pose_of(xyz: np.ndarray, rpy: np.ndarray) -> Pose:
    """xyz (3,) [m], rpy (3,) [rad]."""
    roll, pitch, yaw = rpy
    return Pose.of(rot_z(yaw) @ rot_y(pitch) @ rot_x(roll), np.asarray(xyz, float))


def origin_pose(joint: ET.Element) -> Pose:
    """Where a joint (or a solid) stands on its link; numbers have been checked."""
    origin = joint.find("origin")
    if origin is None:
        return Pose.identity()
    xyz = np.array(origin.get("xyz", "0 0 0").split(), float)
    return pose_of(xyz, np.array(origin.get("rpy", "0 0 0").split(), float))


def origin_element(pose: Pose) -> ET.Element:
    """<origin> of a pose, written in full."""
    rpy = roll_pitch_yaw(pose.rotation)
    xyz = " ".join(repr(float(v)) for v in pose.position)
    return ET.Element("origin", {"xyz": xyz, "rpy": " ".join(repr(v) for v in rpy)})


def roll_pitch_yaw(rotation: np.ndarray) -> tuple[float, float, float]:
    """Angles [rad] of R = Rz(yaw) Ry(pitch) Rx(roll); with pitch at a right angle the roll is 0."""
    level = math.hypot(rotation[0, 0], rotation[1, 0])
    pitch = math.atan2(-rotation[2, 0], level)
    if level < _LEVEL:
        return 0.0, pitch, math.atan2(-rotation[0, 1], rotation[1, 1])
    return math.atan2(rotation[2, 1], rotation[2, 2]), pitch, math.atan2(rotation[1, 0], rotation[0, 0])
