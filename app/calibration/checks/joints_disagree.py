"""Joint angles and flange pose of one row that do not belong together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.calibration.captures import Capture
from app.calibration.checks.tool_active import constant_offset
from app.calibration.points import ANGLE_TOLERANCE, POSITION_TOLERANCE, Points
from app.calibration.result import ToolCalibration, Warning_
from app.calibration.wording import phrase, remark
from app.units import deg, mm

#: Rounding of the written digits is allowed this many times over.
_ROUNDING = 3.0


@dataclass(frozen=True)
class JointsDisagree:
    key: str = "joints_disagree"

    def look(
        self, result: ToolCalibration, captures: Sequence[Capture], context: dict[str, Any]
    ) -> list[Warning_]:
        points: Points | None = context.get("points")
        if points is None or points.disagreement is None or points.robot is None:
            return []
        if constant_offset(points) is not None:
            return []  # said by tool_active
        steps = points.written.steps
        distance, angle = points.disagreement.T
        far = distance > POSITION_TOLERANCE + _ROUNDING * float(np.linalg.norm(steps[:3]))
        turned = angle > ANGLE_TOLERANCE + _ROUNDING * float(np.linalg.norm(steps[3:]))
        wrong = np.flatnonzero(far | turned)
        if not len(wrong):
            return []
        worst = int(wrong[np.argmax(distance[wrong])])
        rows = ", ".join(str(points.captures[i].row) for i in wrong[:5]) + ("…" if len(wrong) > 5 else "")
        every = len(wrong) == len(distance)
        return [
            remark(
                self.key,
                severe=True,
                where=phrase(f"check.joints_disagree_{'every' if every else 'row'}", rows=rows),
                distance=mm(distance[worst]),
                deg=deg(angle[worst]),
                row=points.captures[worst].row,
                robot=points.robot.title,
            )
        ]


CHECK = JointsDisagree()
