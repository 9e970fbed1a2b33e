"""After accepting: turn about the new tool point and watch the true tip.

If the tool point is right, the tip stays where it is while the flange turns about it; if it is off by d (seen in the
flange), the tip wanders by (R - I) d, which is what is measured here.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from app.calibration.result import ToolCalibration
from app.calibration.wording import phrase
from app.estimation import reach
from app.geometry import Pose, exp_so3
from app.kinematics import IkResult, RobotModel, solve_ik
from app.units import from_deg, mm

#: Turns about the tool's X, Y and Z, either way [rad].
TURNS = (from_deg(25.0), from_deg(25.0), from_deg(45.0))
_STEP = from_deg(2.5)


@dataclass(frozen=True, eq=False)
class Verification:
    """What the turn showed.

    Args:
        flanges: commanded poses of the flange, in order.
        axes: (m,) 0, 1, 2: the tool's axis turned about at each pose.
        joints: (m, k) joint positions, where a robot was given.
        trace: (m, 3) the true tip in base [m].
        wander: largest distance of the tip from where it started [m].
        rms: root mean square of that distance [m].
        expected: what the predicted uncertainty allows in 95 of 100 cases [m].
        stopped: why the arm could not finish, or "".
        hindered: the same before it was put into words.
    """

    flanges: tuple[Pose, ...]
    axes: np.ndarray
    joints: np.ndarray | None
    trace: np.ndarray
    wander: float
    rms: float
    expected: float
    stopped: str = ""
    hindered: IkResult | None = None

    @property
    def inside(self) -> bool | None:
        """True where the tip wandered no further than predicted; None where nothing was predicted."""
        return self.wander <= self.expected if np.isfinite(self.expected) else None

    def sentence(self, language: str = "en") -> str:
        """What an operator reads."""
        key = {None: "wander", True: "inside", False: "outside"}[self.inside]
        said = phrase(f"verify.{key}", wander=mm(self.wander), expected=mm(self.expected))
        if self.stopped:
            said = phrase("verify.stopped", said=said, why=self.stopped)
        return said.text(language)


def turning_path(T_base_tool: Pose, T_flange_tool: Pose) -> tuple[tuple[Pose, ...], np.ndarray]:
    """Flange poses that turn the tool about its own point: 0, +, 0, -, 0 about X, Y, then Z.

    Returns:
        poses, axes (m,).
    """
    back = T_flange_tool.inverse()
    poses, axes = [], []
    for axis, most in enumerate(TURNS):
        steps = max(int(np.ceil(most / _STEP)), 1)
        up = np.linspace(0.0, most, steps + 1)
        for angle in np.concatenate([up, up[-2::-1], -up[1:], -up[-2::-1]]):
            poses.append(T_base_tool @ Pose.of(exp_so3(angle * np.eye(3)[axis])) @ back)
            axes.append(axis)
    return tuple(poses), np.array(axes)


def verify(
    result: ToolCalibration,
    T_base_flange: Pose,
    tip: Callable[[Pose, np.ndarray | None], np.ndarray],
    *,
    robot: RobotModel | None = None,
    q_start: np.ndarray | None = None,
) -> Verification:
    """Turns about the tool point that was found and follows the true tip.

    Args:
        result: the calibration.
        T_base_flange: where the turn starts; the tip best stands at the spike.
        tip: (flange, joints or None) -> (3,) where the true tip is in base [m]; the world knows, the wizard does not.
        robot: where given, the poses are reached by it and the turn stops where it cannot follow.
        q_start: (k,) joint positions at the start.
    """
    poses, axes = turning_path(T_base_flange @ result.T_flange_tool, result.T_flange_tool)
    joints: list[np.ndarray] = []
    stopped, hindered = "", None
    if robot is not None:
        q = robot.home if q_start is None else np.asarray(q_start, float)
        for pose in poses:
            found: IkResult = solve_ik(robot, pose, q)
            if not found.reached:
                stopped, hindered = found.sentence(), found
                break
            q = found.q
            joints.append(q)
        poses, axes = poses[: len(joints)], axes[: len(joints)]
    trace = np.array([tip(pose, joints[i] if joints else None) for i, pose in enumerate(poses)]).reshape(
        -1, 3
    )
    away = np.linalg.norm(trace - trace[0], axis=1) if len(trace) else np.zeros(1)
    return Verification(
        poses,
        axes,
        np.array(joints) if robot is not None else None,
        trace,
        float(away.max()),
        float(np.sqrt(np.mean(away**2))),
        expected_wander(result),
        stopped,
        hindered,
    )


def expected_wander(result: ToolCalibration) -> float:
    """Largest wander that the predicted uncertainty allows in 95 of 100 cases [m]; nan without touches."""
    if not len(result.residual_vectors) or not result.sigma > 0:
        return float("nan")
    most = 0.0
    for axis, angle in enumerate(TURNS):
        turned = exp_so3(angle * result.T_flange_tool.rotation[:, axis]) - np.eye(3)
        most = max(most, float(np.linalg.eigvalsh(turned @ result.covariance @ turned.T)[-1]))
    return float(np.sqrt(most)) * reach(result.dof)
