"""Universal Robots: `set_tcp(p[x, y, z, rx, ry, rz])`; metres and rotation vector."""

from __future__ import annotations

import bisect
import re
from functools import partial
from typing import Any

import numpy as np

from app.calibration.exchange._frame import NUMBER, ToolFrame, frame_of, number, without_comments, written
from app.calibration.exchange._tools import Reader, Rows, Tool, all_zero
from app.geometry import exp_so3

_SIX = r"\s*,\s*".join([f"({NUMBER})"] * 6)
_TCP = re.compile(r"set_tcp\s*\(\s*p\s*\[\s*" + _SIX + r"\s*\]")
_LOAD = re.compile(
    rf"set_(?:target_)?payload\s*\(\s*({NUMBER})\s*,\s*\[\s*({NUMBER})\s*,\s*({NUMBER})\s*,\s*({NUMBER})\s*\]"
)
_NAME = re.compile(r"^[ \t]{0,80}#[ \t]{0,80}tool:[ \t]{0,80}(\w{1,64})", re.MULTILINE)


class UrScript(Reader):
    key = "ur_script"
    title = "Universal Robots set_tcp"
    suffix = ".script"
    suffixes = (".script", ".urscript")
    lacks = "it calls no set_tcp"
    absent = "set_tcp(p[x, y, z, rx, ry, rz])"

    def knows(self, text: str) -> bool:
        return "set_tcp" in text and _TCP.search(without_comments(text, "#")) is not None

    def write(self, frame: ToolFrame) -> str:
        values = ", ".join(written(v, 12) for v in (*frame.pose.position, *frame.pose.rotvec))
        lines = [f"# tool: {frame.name}", f"set_tcp(p[{values}])"]
        if frame.mass > 0:
            com = ", ".join(written(v, 9) for v in frame.com)
            lines.append(f"set_target_payload({written(frame.mass)}, [{com}])")
        return "\n".join(lines) + "\n"

    def tools(self, text: str) -> list[Tool]:
        if "set_tcp" not in text:
            return []
        live = without_comments(text, "#")
        rows = Rows(text)
        names = [(found.start(), found.group(1)) for found in _NAME.finditer(text)]
        loads = [(found.start(), found.groups()) for found in _LOAD.finditer(live)]
        tools = []
        for found in _TCP.finditer(live):
            place, numbers = found.start(), found.groups()
            name = _near(names, place) or ""
            load = _near(loads, place, behind=True)
            row = rows(place)
            make = partial(_frame, name or "tool", row, numbers, load)
            tools.append(Tool(name, 0, row, numbers, all_zero(numbers), make))
        return tools


def _near(marks: list[tuple[int, Any]], place: int, *, behind: bool = False) -> Any:
    """What stands last before a place, or first behind it; else the nearest there is; None where there is none."""
    if not marks:
        return None
    at = bisect.bisect_left(marks, place, key=lambda mark: mark[0]) - (0 if behind else 1)
    return marks[min(max(at, 0), len(marks) - 1)][1]


def _frame(name: str, row: int, numbers: tuple[str, ...], load: tuple[str, ...] | None) -> ToolFrame:
    values = np.array([number(v, row) for v in numbers])
    mass, *com = [number(v) for v in load] if load else [0.0, 0.0, 0.0, 0.0]
    return frame_of(name, exp_so3(values[3:]), values[:3], mass, np.array(com))


FORMAT = UrScript()
