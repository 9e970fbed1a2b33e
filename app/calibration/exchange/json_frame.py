"""JSON: teachframe.frame/1, and what `teachframe solve --json` prints (teachframe.tool/1); millimetres."""

from __future__ import annotations

import msgspec
import numpy as np

from app.calibration.exchange._frame import ToolFrame, frame_of, unit_quaternion
from app.calibration.exchange._tools import Reader, Tool
from app.errors import FileFormatError
from app.geometry import rotation_from_quaternion
from app.typed import learnt
from app.units import from_mm, mm

FRAME, SOLVED = "teachframe.frame/1", "teachframe.tool/1"


class _Frame(msgspec.Struct):
    """The parts that are read; the rest is ignored."""

    format: str
    quaternion_wxyz: tuple[float, float, float, float]
    tool_mm: tuple[float, float, float]
    name: str = "tool"
    mass_kg: float = 0.0
    com_mm: tuple[float, float, float] = (0.0, 0.0, 0.0)


_FRAME = learnt(_Frame)


class JsonFrame(Reader):
    key = "json"
    title = "JSON"
    suffix = ".json"
    suffixes = (".json",)
    lacks = "it holds no frame"
    absent = FRAME

    def knows(self, text: str) -> bool:
        return text.lstrip().startswith("{") and '"format"' in text

    def write(self, frame: ToolFrame) -> str:
        out = {
            "format": FRAME,
            "name": frame.name,
            "tool_mm": mm(frame.pose.position).tolist(),
            "quaternion_wxyz": frame.pose.quaternion.tolist(),
            "mass_kg": frame.mass,
            "com_mm": [mm(v) for v in frame.com],
        }
        return msgspec.json.format(msgspec.json.encode(out), indent=2).decode() + "\n"

    def tools(self, text: str) -> list[Tool]:
        frame = _read(text)
        return [Tool(frame.name, 0, 1, "", False, lambda: frame)]


def _read(text: str) -> ToolFrame:
    try:
        found = _FRAME.decode(text)
    except (msgspec.DecodeError, RecursionError, UnicodeError) as error:
        raise FileFormatError(f"cannot be read ({error})", row=1, expected=FRAME) from None
    if found.format not in (FRAME, SOLVED):
        raise FileFormatError(f"its format is {found.format[:40]!r}", row=1, expected=f"{FRAME} or {SOLVED}")
    rotation = rotation_from_quaternion(unit_quaternion(list(found.quaternion_wxyz)))
    com = from_mm(np.array(found.com_mm))
    return frame_of(found.name, rotation, from_mm(np.array(found.tool_mm)), found.mass_kg, com)


FORMAT = JsonFrame()
