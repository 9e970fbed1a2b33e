"""Touches of which some were made with the wrist flipped over.

A pose of the tool can be reached with the wrist either way round: the middle one of the last three joints bent to one
side or to the other. Each way an error of the joints' zeros moves the tool differently, so makers ask for one
configuration: KUKA's status bits, FANUC's FLIP and NOFLIP, ABB's confdata.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.calibration.captures import Capture, of_role
from app.calibration.points import Points
from app.calibration.result import ToolCalibration, Warning_
from app.calibration.wording import remark
from app.kinematics import RobotModel

#: Sine of the wrist's bend below which it is straight, and neither way round: 3 degrees.
_STRAIGHT = 0.05
_SHOWN = 5


@dataclass(frozen=True)
class MixedConfiguration:
    key: str = "mixed_configuration"

    def look(
        self, result: ToolCalibration, captures: Sequence[Capture], context: dict[str, Any]
    ) -> list[Warning_]:
        points: Points | None = context.get("points")
        touches = of_role(captures, "touch")
        if points is None or points.robot is None or points.robot.joint_count < 3:
            return []
        if len(touches) < 2 or any(c.q is None or len(c.q) != points.robot.joint_count for c in touches):
            return []
        sides = wrist_sides(points.robot, np.array([c.q for c in touches]))
        one, other = np.flatnonzero(sides > 0), np.flatnonzero(sides < 0)
        if not len(one) or not len(other):
            return []
        flipped, usual = (one, other) if len(one) <= len(other) else (other, one)
        if len(one) == len(other) and 0 in flipped:  # of two halves, the one that came later
            flipped, usual = usual, flipped
        return [
            remark(self.key, touches=_numbers(flipped), others=_numbers(usual), touch=int(flipped[0]) + 1)
        ]


def wrist_sides(robot: RobotModel, qs: np.ndarray) -> np.ndarray:
    """(m,) 1 or -1 by which way round the wrist is, 0 where it is straight; qs (m, n) [rad or m].

    The last three axes of a wrist span a volume whose sign changes when the middle joint goes through straight: for a
    wrist whose axes meet it is the sine of the middle joint (Siciliano et al., Robotics, section 3.3.2).
    """
    axes = robot.chain.frames(qs).axes[:, -3:]
    volume = np.linalg.det(axes)
    return np.where(np.abs(volume) < _STRAIGHT, 0.0, np.sign(volume))


def _numbers(touches: np.ndarray) -> str:
    shown = ", ".join(str(k + 1) for k in touches[:_SHOWN])
    return shown + ("…" if len(touches) > _SHOWN else "")


CHECK = MixedConfiguration()
