"""Strokes that make a left-handed frame, or a Z that points back into the flange."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.calibration.captures import Capture
from app.calibration.checks._strokes import strokes
from app.calibration.result import ToolCalibration, Warning_
from app.calibration.wording import remark
from app.units import from_mm

#: Tools shorter than this do not say which way is out [m].
_SHORT = from_mm(20.0)
#: Cosine beyond which Z clearly points back.
_BACK = -0.3


@dataclass(frozen=True)
class LeftHanded:
    key: str = "left_handed"

    def look(
        self, result: ToolCalibration, captures: Sequence[Capture], context: dict[str, Any]
    ) -> list[Warning_]:
        shown = strokes(result, captures)
        if len(shown) == 3:
            volume = float(np.linalg.det([v / np.linalg.norm(v) for v in shown.values()]))
            if volume < 0.0:
                return [remark(self.key, severe=True)]
        length = float(np.linalg.norm(result.tool_point))
        if len(shown) < 1 or length < _SHORT or not {"z", "y"} & set(shown):
            return []
        z = result.T_flange_tool.rotation[:, 2]
        if float(z @ result.tool_point) / length > _BACK:
            return []
        if "z" in shown:
            return [remark("axis_reversed")]
        return [remark(self.key, "left_handed_xy")]


CHECK = LeftHanded()
