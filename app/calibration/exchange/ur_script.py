"""Universal Robots: `set_tcp(p[x, y, z, rx, ry, rz])`; metres and rotation vector."""

from __future__ import annotations

import re

import numpy as np

from app.calibration.exchange._frame import NUMBER, ToolFrame, frame_of, number, row_of, written
from app.errors import FileFormatError
from app.geometry import exp_so3

_SIX = r"\s*,\s*".join([f"({NUMBER})"] * 6)
_TCP = re.compile(r"set_tcp\s*\(\s*p\s*\[\s*" + _SIX + r"\s*\]")
_LOAD = re.compile(
    rf"set_(?:target_)?payload\s*\(\s*({NUMBER})\s*,\s*\[\s*({NUMBER})\s*,\s*({NUMBER})\s*,\s*({NUMBER})\s*\]"
)
_NAME = re.compile(r"^\s*#\s*tool:\s*(\w+)", re.MULTILINE)


class UrScript:
    key = "ur_script"
    title = "Universal Robots set_tcp"
    suffix = ".script"

    def knows(self, text: str) -> bool:
        return _TCP.search(text) is not None

    def write(self, frame: ToolFrame) -> str:
        values = ", ".join(written(v, 12) for v in (*frame.pose.position, *frame.pose.rotvec))
        lines = [f"# tool: {frame.name}", f"set_tcp(p[{values}])"]
        if frame.mass > 0:
            com = ", ".join(written(v, 9) for v in frame.com)
            lines.append(f"set_target_payload({written(frame.mass)}, [{com}])")
        return "\n".join(lines) + "\n"

    def read(self, text: str) -> ToolFrame:
        found = _TCP.search(text)
        if not found:
            raise FileFormatError("no set_tcp", row=1, expected="set_tcp(p[x, y, z, rx, ry, rz])")
        values = np.array([number(v, row_of(text, found.start())) for v in found.groups()])
        load, name = _LOAD.search(text), _NAME.search(text)
        mass, *com = [number(v) for v in load.groups()] if load else [0.0, 0.0, 0.0, 0.0]
        label = name.group(1) if name else "tool"
        return frame_of(label, exp_so3(values[3:]), values[:3], mass, np.array(com))


FORMAT = UrScript()
