"""A tool was still active while teaching: the controller showed its tip, not the flange.

Where the session says which tool is active, it is named; points that were kept as flange poses all the same are none
the worse for it, and that is only told."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.calibration.captures import Capture, of_role
from app.calibration.points import ANGLE_TOLERANCE, POSITION_TOLERANCE, Points
from app.calibration.result import ToolCalibration, Warning_
from app.calibration.wording import remark
from app.geometry import Pose, angle_between
from app.units import from_mm, mm

#: Tools shorter than this are suspicious: the "flange" hardly moved although it turned [m].
SHORT = from_mm(10.0)


@dataclass(frozen=True, eq=False)
class SessionTool:
    """The tool that is active in the controller while the points are solved.

    Args:
        name: what it is called there.
        T_flange_tool: where it is.
        recorded: True where the points were recorded there, as flange poses, while it was active.
    """

    name: str
    T_flange_tool: Pose
    recorded: bool

    @property
    def is_flange(self) -> bool:
        """True for a tool that is none."""
        return bool(np.allclose(self.T_flange_tool.matrix, np.eye(4), atol=1e-9))


@dataclass(frozen=True)
class ToolActive:
    key: str = "tool_active"

    def look(
        self, result: ToolCalibration, captures: Sequence[Capture], context: dict[str, Any]
    ) -> list[Warning_]:
        active = context.get("tool_active")
        if active:
            named = isinstance(active, str)
            return [remark(self.key, "tool_active_named" if named else "", severe=True, tool=active)]
        tool: SessionTool | None = context.get("session_tool")
        if tool is not None and tool.is_flange:
            tool = None
        name = "" if tool is None else tool.name
        offset = constant_offset(context.get("points"))
        if offset is not None and np.linalg.norm(offset) > POSITION_TOLERANCE:
            text = ", ".join(f"{v:.1f}" for v in mm(offset))
            theirs = tool is not None and (
                np.linalg.norm(tool.T_flange_tool.position - offset) <= POSITION_TOLERANCE
            )
            key = "tool_active_offset_of" if theirs else "tool_active_offset"
            return [remark(self.key, key, severe=True, offset=text, tool=name)]
        length = float(np.linalg.norm(result.tool_point))
        if of_role(captures, "touch") and length < SHORT:
            key = "tool_active_short" if tool is None else "tool_active_short_of"
            return [remark(self.key, key, severe=True, length=mm(length), tool=name)]
        if tool is not None and tool.recorded and captures and not of_role(captures, "known"):
            return [remark(self.key, "tool_active_flange", note=True, tool=name)]
        return []


def constant_offset(points: Points | None) -> np.ndarray | None:
    """(3,) the tool that lies between joints and poses in every row alike [m]; None where there is no such tool."""
    if points is None or points.disagreement is None or points.robot is None or len(points.captures) < 2:
        return None
    if not (points.disagreement[:, 0] > POSITION_TOLERANCE).any():
        return None
    offsets = []
    for capture in points.captures:
        assert capture.q is not None
        offsets.append(points.robot.forward(capture.q).inverse().matrix @ capture.T_base_flange.matrix)
    matrices = np.array(offsets)
    spread = np.linalg.norm(matrices[:, :3, 3] - matrices[0, :3, 3], axis=1).max()
    turn = np.max(angle_between(matrices[:1, :3, :3], matrices[:, :3, :3]))
    if spread > POSITION_TOLERANCE or turn > ANGLE_TOLERANCE:
        return None
    return matrices[:, :3, 3].mean(axis=0)


CHECK = ToolActive()
