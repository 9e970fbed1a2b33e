"""Where the ghost stands: joints that bring the tool point to an exaggerated place, near the arm's own."""

from __future__ import annotations

import numpy as np

from app.kinematics import RobotModel

_STEPS = 12
_DAMPING = 1e-4
_CLOSE = 1e-5  # m


def joints_for_point(
    robot: RobotModel, q: np.ndarray, p_flange: np.ndarray, p_base: np.ndarray
) -> np.ndarray:
    """(n,) joints, starting from q (n,), whose tool point is as near to a place in base as it gets.

    Only the point counts: the arm takes the smallest turn of its joints that moves it there. Limits do not hold, a
    ghost may stand where an arm may not.

    Args:
        p_flange: (3,) the tool point in the flange [m].
        p_base: (3,) where it is wanted [m].
    """
    chain = robot.chain
    q = np.array(q, float)
    for _ in range(_STEPS):
        frames = chain.frames(q[None])
        point = frames.flange_positions[0] + frames.flange_rotations[0] @ p_flange
        miss = p_base - point
        if miss @ miss < _CLOSE**2:
            break
        jacobian = chain.jacobian_columns(frames, point[None])[0]
        q = q + jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + _DAMPING * np.eye(3), miss)
    return q
