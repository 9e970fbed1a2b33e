"""Damped inverse kinematics that keeps the last good pose and says why it stopped."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from app.geometry.pose import Pose
from app.geometry.rotation import log_so3
from app.kinematics.robot import RobotModel

Reason = Literal["reached", "limit", "singular", "out_of_reach"]

#: One radian weighs as much as this many metres, so that a step balances both.
ROTATION_WEIGHT = 0.3
SINGULAR = 0.02  # smallest singular value of the weighted Jacobian that still counts as regular


@dataclass(frozen=True, eq=False)
class IkResult:
    """Where the arm ended and why it did not go further.

    Args:
        q: (n,) within the limits; the nearest pose found, never worse than the start.
        reason: "reached", or what stopped it.
        joints: the joints (counted from 1) that sit on a limit, where that is the reason.
        position_error: distance left [m].
        rotation_error: angle left [rad].
        steps: iterations used.
    """

    q: np.ndarray
    reason: Reason
    joints: tuple[int, ...]
    position_error: float
    rotation_error: float
    steps: int

    @property
    def reached(self) -> bool:
        return self.reason == "reached"

    def sentence(self) -> str:
        """Why it stopped, for an operator."""
        if self.reason == "limit":
            names = ", ".join(f"axis {j}" for j in self.joints)
            return f"{names} at its limit" if len(self.joints) == 1 else f"{names} at their limits"
        return {
            "reached": "reached",
            "singular": "the wrist is straight (singular): move another way round",
            "out_of_reach": "out of reach",
        }[self.reason]


def solve_ik(
    robot: RobotModel,
    target: Pose,
    q_start: np.ndarray,
    *,
    T_flange_tool: Pose | None = None,
    max_steps: int = 60,
    position_tolerance: float = 1e-6,
    rotation_tolerance: float = 1e-6,
    damping: float = 1e-4,
) -> IkResult:
    """Joint angles that bring the tool to `target`, from `q_start`.

    Levenberg-Marquardt on the weighted pose error; a joint that reaches its limit is held there and the
    others go on. The step is only taken when it lowers the error, so the result is never worse than the start.

    Args:
        target: T_base_tool that is wanted.
        q_start: (n,) [rad or m].
        T_flange_tool: the tool; identity aims the flange.
        max_steps: bound on the iterations.
        position_tolerance: [m].
        rotation_tolerance: [rad].

    Source: Sugihara (2011), error-proportional damping; limits by an active set.
    """
    tool = (T_flange_tool or Pose.identity()).matrix
    want = target.matrix
    lower, upper = robot.lower, robot.upper
    q = np.clip(np.asarray(q_start, float), lower, upper)

    def error(angles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        flange = robot.flange_matrix(angles)
        got = flange @ tool
        e = np.empty(6)
        e[:3] = want[:3, 3] - got[:3, 3]
        e[3:] = log_so3(want[:3, :3] @ got[:3, :3].T) * ROTATION_WEIGHT
        return e, got[:3, 3] - flange[:3, 3]

    e, lever = error(q)
    cost = e @ e
    factor, held, singular, steps = 1.0, np.zeros(len(q), bool), False, 0
    for steps in range(1, max_steps + 1):  # noqa: B007  (read after the loop)
        if _done(e, position_tolerance, rotation_tolerance):
            break
        jacobian = robot.jacobian(q)
        jacobian[:3] += np.cross(jacobian[3:].T, lever).T
        jacobian[3:] *= ROTATION_WEIGHT
        gradient = jacobian.T @ e
        held = ((q <= lower) & (gradient < 0)) | ((q >= upper) & (gradient > 0))
        free = ~held
        if not free.any():
            break
        part = jacobian[:, free]
        singular = bool(np.linalg.svd(part, compute_uv=False)[-1] < SINGULAR)
        hessian = part.T @ part + (damping * factor * min(cost, 1.0) + 1e-12) * np.eye(int(free.sum()))
        step = np.zeros(len(q))
        step[free] = np.linalg.solve(hessian, gradient[free])
        largest = np.abs(step).max()
        if largest > 0.5:  # a linear model is not believed further than this [rad]
            step *= 0.5 / largest
        trial = np.clip(q + step, lower, upper)
        trial_e, trial_lever = error(trial)
        trial_cost = trial_e @ trial_e
        if trial_cost < cost:
            stalled = cost - trial_cost < 1e-9 * cost
            q, e, lever, cost = trial, trial_e, trial_lever, trial_cost
            factor = max(factor * 0.3, 1e-3)
            if stalled:
                break
        else:
            factor *= 10.0
            if factor > 1e8:
                break
    reason: Reason = "reached"
    on_limit: tuple[int, ...] = ()
    if not _done(e, position_tolerance, rotation_tolerance):
        if held.any():
            reason, on_limit = "limit", tuple(int(j) + 1 for j in np.flatnonzero(held))
        elif _beyond(robot, want, tool):
            reason = "out_of_reach"
        else:
            reason = "singular" if singular else "out_of_reach"
    return IkResult(
        q,
        reason,
        on_limit,
        float(np.linalg.norm(e[:3])),
        float(np.linalg.norm(e[3:])) / ROTATION_WEIGHT,
        steps,
    )


def _done(e: np.ndarray, position_tolerance: float, rotation_tolerance: float) -> bool:
    return bool(
        e[:3] @ e[:3] <= position_tolerance**2
        and e[3:] @ e[3:] <= (rotation_tolerance * ROTATION_WEIGHT) ** 2
    )


def _beyond(robot: RobotModel, want: np.ndarray, tool: np.ndarray) -> bool:
    """True where the wanted flange lies outside the arm's largest radius."""
    flange = want[:3, 3] - want[:3, :3] @ tool[:3, :3].T @ tool[:3, 3]
    chain = robot.chain
    origin = chain.translations[0]
    axis = chain.rotations[0] @ chain.axes[0]
    p = flange - origin
    return bool(np.linalg.norm(p - (p @ axis) * axis) > robot.reach + 1e-6)
