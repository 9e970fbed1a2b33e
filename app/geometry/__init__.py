"""Rotations, poses, the makers' angle conventions, lines and circles.

All arrays are float64; a leading `...` in a shape means any batch. Results are new arrays; those kept in
a frozen object are read-only.

    rotation.py      SO(3): exp, log, quaternions (wxyz)
    pose.py          SE(3) as a frozen value
    conventions.py   one table of how makers write an orientation
    rigid.py         best rigid motion between point sets
"""

from app.geometry.conventions import CONVENTIONS, AngleConvention, convention
from app.geometry.pose import Pose
from app.geometry.rigid import fit_rigid
from app.geometry.rotation import (
    angle_between,
    exp_so3,
    log_so3,
    nearest_rotation,
    quaternion_from_rotation,
    rot_x,
    rot_y,
    rot_z,
    rotation_from_quaternion,
    skew,
)

__all__ = [
    "CONVENTIONS",
    "AngleConvention",
    "Pose",
    "angle_between",
    "convention",
    "exp_so3",
    "fit_rigid",
    "log_so3",
    "nearest_rotation",
    "quaternion_from_rotation",
    "rot_x",
    "rot_y",
    "rot_z",
    "rotation_from_quaternion",
    "skew",
]
