"""Which joints a singular pose is about."""

from __future__ import annotations

import numpy as np

from app.kinematics.inverse import ROTATION_WEIGHT
from app.kinematics.robot import RobotModel

_TAKES_PART = 0.35  # of the largest share


def singular_joints(robot: RobotModel, q: np.ndarray) -> tuple[int, ...]:
    """Joints, counted from 1, that undo each other's motion most nearly at q (n,) [rad or m].

    They are those with a share in the joint motion that moves the flange least, of all motions that move it at all:
    the right singular vector of the Jacobian's smallest singular value (Golub and Van Loan, Matrix Computations,
    section 2.4). At a straight wrist these are the two joints whose axes lie on one line.
    """
    jacobian = robot.jacobian(q)
    jacobian[3:] *= ROTATION_WEIGHT
    _, _, rows = np.linalg.svd(jacobian, full_matrices=False)
    shares = np.abs(rows[-1])
    return tuple(int(k) + 1 for k in np.flatnonzero(shares >= _TAKES_PART * shares.max()))
