"""Damped inverse kinematics that keeps the last good pose and says why it stopped."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
import pinocchio as pin  # pyright: ignore[reportMissingImports]  (found through a .pth hook)
from scipy.linalg.lapack import dposv  # pyright: ignore[reportAttributeAccessIssue]  (made at import)

from app.geometry.pose import Pose
from app.kinematics.robot import RobotModel

Reason = Literal["reached", "limit", "singular", "out_of_reach"]

#: One radian weighs as much as this many metres, so that a step balances both.
ROTATION_WEIGHT = 0.3
_LARGEST_STEP = 0.5  # rad (or m): a linear model is not believed further than this
_RESTARTS, _RESTART_STEPS = 12, 50
_RADIUS_MARGIN = 1.01  # the radius is found by search
_HOPELESS = 0.003  # a search for the reason gives up where a step wins less than this share of the error
_EYE, _ZERO = np.eye(6), np.zeros(3)


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
            "singular": "the arm is stretched or its wrist is straight (singular): move another way round",
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
    explain: bool = True,
) -> IkResult:
    """Joint angles that bring the tool to `target`, from `q_start`.

    Levenberg-Marquardt on the weighted pose error; a joint that reaches its limit is held there and the
    others go on. A step is only taken when it lowers the error, so the result is never worse than the start.

    Where the target is not reached, the reason is found by asking what would have helped: "limit" where the
    same search without limits gets there, "singular" where only a search from elsewhere does, "out_of_reach"
    where none does.

    Args:
        target: T_base_tool that is wanted.
        q_start: (n,) [rad or m].
        T_flange_tool: the tool; identity aims the flange.
        max_steps: bound on the iterations.
        position_tolerance: [m].
        rotation_tolerance: [rad].
        explain: False spares the search for the reason (milliseconds where the target is not reached, for a
            drag at 20 a second): a joint held by its limit is named, and being stuck without one is called
            "singular", as every such place is.

    Source: Sugihara (2011), error-proportional damping; limits by an active set.
    """
    problem = _Problem(robot, target, T_flange_tool, position_tolerance, rotation_tolerance)
    start = problem.inside(np.asarray(q_start, float))
    q, error, done, held, steps = problem.descend(start, max_steps, damping, limited=True)
    reason: Reason = "reached" if done else problem.why(q, held, damping, explain)
    return IkResult(
        q,
        reason,
        held if reason == "limit" else (),
        math.hypot(*error[:3].tolist()),
        math.hypot(*error[3:].tolist()) / ROTATION_WEIGHT,
        steps,
    )


class _Problem:
    """One target: the weighted error and the descent on it.

    A drag asks for this thousands of times, so sums over six numbers are done on Python floats and products
    by `dot`: numpy's general calls would cost more than the arithmetic.
    """

    def __init__(
        self,
        robot: RobotModel,
        target: Pose,
        tool: Pose | None,
        position_tolerance: float,
        rotation_tolerance: float,
    ):
        self.robot, self.model, self.data, self.flange = robot, robot.model, robot.data, robot.flange_id
        self.lower, self.upper = robot.lower.tolist(), robot.upper.tolist()
        self.lever = _ZERO if tool is None else np.array(tool.position)
        want = target.matrix
        self.position = want[:3, 3]
        rotation = want[:3, :3] if tool is None else want[:3, :3].dot(tool.rotation.T)
        self.rotation = pin.SE3(rotation, _ZERO)
        self.position2 = position_tolerance**2
        self.rotation2 = (rotation_tolerance * ROTATION_WEIGHT) ** 2

    def error(self, q: np.ndarray) -> tuple[np.ndarray, np.ndarray, float, bool]:
        """Weighted error (6,), the flange-to-tool-point lever in base (3,), its square, and whether it will do."""
        pin.computeJointJacobians(self.model, self.data, q)
        flange = pin.updateFramePlacement(self.model, self.data, self.flange)
        tool_point = flange.act(self.lever)
        e = np.empty(6)
        e[:3] = self.position - tool_point
        e[3:] = pin.log3(self.rotation.act(flange.inverse()).rotation)
        e[3:] *= ROTATION_WEIGHT
        x, y, z, a, b, c = e.tolist()
        distance2, turn2 = x * x + y * y + z * z, a * a + b * b + c * c
        done = distance2 <= self.position2 and turn2 <= self.rotation2
        return e, tool_point - flange.translation, distance2 + turn2, done

    def jacobian(self, lever: np.ndarray) -> np.ndarray:
        """(6, n) of the weighted error's fall, at the pose `error` was last asked for."""
        jacobian = pin.getFrameJacobian(self.model, self.data, self.flange, pin.LOCAL_WORLD_ALIGNED)
        if jacobian.ndim == 1:  # of a single joint pin gives a plain vector
            jacobian = jacobian[:, None]
        x, y, z = lever.tolist()
        turn = np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])  # w -> w x lever
        jacobian[:3] += turn.dot(jacobian[3:])
        jacobian[3:] *= ROTATION_WEIGHT
        return jacobian

    def inside(self, q: np.ndarray) -> np.ndarray:
        """The joints brought inside their limits."""
        rows = zip(q.tolist(), self.lower, self.upper, strict=True)
        return np.array([low if x < low else high if x > high else x for x, low, high in rows])

    def held(self, q: np.ndarray, gradient: np.ndarray) -> list[bool]:
        """Joints that sit on a limit and are pushed against it."""
        rows = zip(q.tolist(), gradient.tolist(), self.lower, self.upper, strict=True)
        return [(x <= low and g < 0.0) or (x >= high and g > 0.0) for x, g, low, high in rows]

    def descend(
        self, q: np.ndarray, max_steps: int, damping: float, *, limited: bool
    ) -> tuple[np.ndarray, np.ndarray, bool, tuple[int, ...], int]:
        """Steps until done or stuck: joints, weighted error, done, joints held by limits (from 1), steps."""
        held: list[bool] = []
        e, lever, cost, done = self.error(q)
        factor, steps = 1.0, 0
        jacobian: np.ndarray | None = None
        normal = _EYE
        while steps < max_steps and not done:
            steps += 1
            if jacobian is None:
                jacobian = self.jacobian(lever)
                if limited:
                    held = self.held(q, e.dot(jacobian))
                    if any(held):
                        jacobian[:, held] = 0.0
                normal = jacobian.dot(jacobian.T)
            # J^T (J J^T + k)^-1 e: the 6 x 6 form of the damped step, right for any number of joints.
            _, x, _ = dposv(normal + _EYE * (damping * factor * min(cost, 1.0) + 1e-12), e)
            step = x.dot(jacobian)
            moves = step.tolist()
            largest = max(max(moves), -min(moves))
            if largest > _LARGEST_STEP:
                step *= _LARGEST_STEP / largest
            trial = q + step
            if limited:
                trial = self.inside(trial)
            trial_e, trial_lever, trial_cost, done = self.error(trial)
            if trial_cost < cost:
                stalled = cost - trial_cost < (1e-9 if limited else _HOPELESS) * cost
                q, e, lever, cost, jacobian = trial, trial_e, trial_lever, trial_cost, None
                factor = max(factor * 0.3, 1e-3)
                if stalled:
                    break
            else:
                done = False
                factor *= 10.0
                if factor > 1e8:
                    break
        return q, e, done, tuple(k + 1 for k, stuck in enumerate(held) if stuck), steps

    def why(self, q: np.ndarray, held: tuple[int, ...], damping: float, explain: bool) -> Reason:
        """What kept the arm from the target."""
        robot = self.robot
        flange = self.position - self.rotation.rotation @ self.lever
        distance = math.dist(flange.tolist(), robot.chain.translations[0].tolist())
        if distance > _RADIUS_MARGIN * robot.radius:
            return "out_of_reach"  # farther than the arm gets in any direction: no need to try
        if not explain:
            return "limit" if held else "singular"
        rng = np.random.default_rng(0)
        start = q
        for _ in range(1 + _RESTARTS):
            _, _, done, _, _ = self.descend(start, _RESTART_STEPS, damping, limited=False)
            if done:
                return "limit" if held else "singular"
            start = rng.uniform(np.maximum(robot.lower, -np.pi), np.minimum(robot.upper, np.pi))
        return "out_of_reach"
