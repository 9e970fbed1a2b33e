"""KUKA KRL: `$TOOL={X 119.5,Y 0.0,Z 352.0,A 0.0,B 54.3,C 0.0}` or `TOOL_DATA[1]={…}`; mm, degrees, Z-Y-X."""

from __future__ import annotations

import re

import numpy as np

from app.calibration.exchange._frame import NUMBER, ToolFrame, frame_of, number, row_of, written, written_mm
from app.errors import FileFormatError
from app.geometry import convention
from app.units import deg, from_deg, from_mm

_FRAME = re.compile(r"(\$TOOL|TOOL_DATA\s*\[\s*\d+\s*\]|FRAME\s+\w+)\s*=\s*\{([^{}]*)\}", re.IGNORECASE)
_NAME = re.compile(r"TOOL_NAME\s*\[[^\]]*\]\s*=\s*\"([^\"\n]*)\"", re.IGNORECASE)
_LOAD = re.compile(r"LOAD(?:_DATA\s*\[\s*\d+\s*\])?\s*=\s*\{\s*M\s+(" + NUMBER + r")", re.IGNORECASE)
_COM = re.compile(r"CM\s*\{([^{}]*)\}", re.IGNORECASE)
_PARTS = "XYZABC"


class KukaKrl:
    key = "kuka_krl"
    title = "KUKA KRL $TOOL"
    suffix = ".src"

    def knows(self, text: str) -> bool:
        return _FRAME.search(text) is not None

    def write(self, frame: ToolFrame) -> str:
        angles = deg(convention("ZYX").from_rotation(frame.pose.rotation))
        values = [*written_mm(frame.pose.position), *(written(v, 10) for v in angles)]
        body = ",".join(f"{part} {value}" for part, value in zip(_PARTS, values, strict=True))
        lines = [f"; {frame.name}", f"$TOOL={{{body}}}"]
        lines += [f'TOOL_NAME[1,]="{frame.name}"', f"TOOL_DATA[1]={{{body}}}"]
        if frame.mass > 0:
            x, y, z = written_mm(np.array(frame.com))
            lines.append(f"LOAD_DATA[1]={{M {written(frame.mass)},CM {{X {x},Y {y},Z {z},A 0,B 0,C 0}}}}")
        return "\n".join(lines) + "\n"

    def read(self, text: str) -> ToolFrame:
        found = _FRAME.search(text)
        if not found:
            raise FileFormatError("no tool frame", row=1, expected="$TOOL={X …,Y …,Z …,A …,B …,C …}")
        row = row_of(text, found.start())
        values = _fields(found.group(2), row)
        missing = [part for part in _PARTS if part not in values]
        if missing:
            raise FileFormatError(
                "a part is missing", row=row, column=missing[0], expected="X, Y, Z, A, B, C"
            )
        name, load, com = _NAME.search(text), _LOAD.search(text), _COM.search(text)
        inside = _fields(com.group(1), None) if com else {}
        return frame_of(
            name.group(1) if name else "tool",
            convention("ZYX").to_rotation(from_deg(np.array([values[p] for p in "ABC"]))),
            from_mm(np.array([values[p] for p in "XYZ"])),
            number(load.group(1)) if load else 0.0,
            from_mm(np.array([inside.get(p, 0.0) for p in "XYZ"])),
        )


def _fields(body: str, row: int | None) -> dict[str, float]:
    out: dict[str, float] = {}
    for part in body.split(","):
        words = part.split()
        if len(words) == 2 and words[0].upper() in _PARTS:
            out[words[0].upper()] = number(words[1], row, words[0])
    return out


FORMAT = KukaKrl()
