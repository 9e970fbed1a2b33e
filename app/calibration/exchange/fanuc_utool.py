"""FANUC: a user tool as the controller lists its frame variables ($MNUTOOL); mm, degrees W, P, R about fixed axes."""

from __future__ import annotations

import re

import numpy as np

from app.calibration.exchange._frame import NUMBER, ToolFrame, frame_of, number, row_of
from app.errors import FileFormatError
from app.geometry import convention
from app.units import deg, from_deg, from_mm, mm

_GAP = r"\s*:\s*(" + NUMBER + r")\s*"
_FRAME = re.compile("X" + _GAP + "Y" + _GAP + "Z" + _GAP + "W" + _GAP + "P" + _GAP + "R" + _GAP)
_NAME = re.compile(r"\$TOOLNAME.*?'([^'\n]*)'|Comment:\s*'([^'\n]*)'")


class FanucUtool:
    key = "fanuc_utool"
    title = "FANUC UTOOL"
    suffix = ".va"

    def knows(self, text: str) -> bool:
        return _FRAME.search(text) is not None

    def write(self, frame: ToolFrame) -> str:
        x, y, z = mm(frame.pose.position)
        w, p, r = deg(convention("XYZ").from_rotation(frame.pose.rotation))
        return (
            "[*SYSTEM*]$MNUTOOL  Storage: CMOS  Access: RW  : ARRAY[1,10] OF POSITION\n"
            f"     [1,1] =   Comment: '{frame.name}'\n"
            "  Group: 1   Config: N D B, 0, 0, 0\n"
            f"  X: {x:.7f}   Y: {y:.7f}   Z: {z:.7f}\n"
            f"  W: {w:.10f}   P: {p:.10f}   R: {r:.10f}\n"
        )

    def read(self, text: str) -> ToolFrame:
        found = _FRAME.search(text)
        if not found:
            raise FileFormatError("no tool frame", row=1, expected="X: … Y: … Z: … W: … P: … R: …")
        values = np.array([number(v, row_of(text, found.start())) for v in found.groups()])
        named = _NAME.search(text)
        name = next((g for g in named.groups() if g), "tool") if named else "tool"
        rotation = convention("XYZ").to_rotation(from_deg(values[3:]))
        return frame_of(name, rotation, from_mm(values[:3]))


FORMAT = FanucUtool()
