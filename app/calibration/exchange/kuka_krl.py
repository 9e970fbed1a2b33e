"""KUKA KRL: a program that stores the tool as number 1; mm, degrees, Z-Y-X.

    TOOL_DATA[1]={X 119.5,Y 0.0,Z 352.0,A 0.0,B 54.3,C 0.0}

Lines stand in a DEF … END, without which no controller takes a .src; reals have their decimal point. Read are `$TOOL=`,
`TOOL_DATA[n]=` (as in $config.dat: the first that is not the bare flange) and named FRAMEs.
"""

from __future__ import annotations

import re

import numpy as np

from app.calibration.exchange._frame import (
    NUMBER,
    ToolFrame,
    frame_of,
    number,
    row_of,
    without_comments,
    written,
    written_mm,
)
from app.errors import FileFormatError
from app.geometry import convention
from app.units import deg, from_deg, from_mm

_FRAME = re.compile(
    r"(\$TOOL|TOOL_DATA\s*\[\s*(\d+)\s*\]|FRAME\s+\w+)\s*=\s*\{(?:\s*FRAME\s*:)?([^{}]*)\}", re.IGNORECASE
)
_NAME = re.compile(r"TOOL_NAME\s*\[\s*(\d+)\s*,?\s*\]\s*=\s*\"([^\"\n]*)\"", re.IGNORECASE)
_LOAD = re.compile(
    r"LOAD(?:_DATA\s*\[\s*(\d+)\s*\])?\s*=\s*\{\s*M\s+(" + NUMBER + r")([^\n]*)", re.IGNORECASE
)
_COM = re.compile(r"CM\s*\{([^{}]*)\}", re.IGNORECASE)
_PARTS = "XYZABC"


class KukaKrl:
    key = "kuka_krl"
    title = "KUKA KRL $TOOL"
    suffix = ".src"

    def knows(self, text: str) -> bool:
        return _FRAME.search(without_comments(text, ";")) is not None

    def write(self, frame: ToolFrame) -> str:
        angles = deg(convention("ZYX").from_rotation(frame.pose.rotation))
        values = [*written_mm(frame.pose.position), *(written(v) for v in angles)]
        lines = [f"DEF {frame.name}( )", f"; tool frame of {frame.name}"]
        lines += [f"TOOL_DATA[1]={_aggregate(_PARTS, values)}", f'TOOL_NAME[1,]="{frame.name}"']
        if frame.mass > 0:
            com = _aggregate(_PARTS, [*written_mm(np.array(frame.com)), "0", "0", "0"])
            inertia = _aggregate("XYZ", ["0", "0", "0"])
            lines.append(f"LOAD_DATA[1]={{M {_real(written(frame.mass))},CM {com},J {inertia}}}")
        return "\n".join([*lines, "$TOOL=TOOL_DATA[1]", "END"]) + "\n"

    def read(self, text: str) -> ToolFrame:
        text = without_comments(text, ";")
        frames = list(_FRAME.finditer(text))
        if not frames:
            raise FileFormatError("no tool frame", row=1, expected="$TOOL={X …,Y …,Z …,A …,B …,C …}")
        several = [_fields(found.group(3), row_of(text, found.start())) for found in frames]
        first = next((k for k, fields in enumerate(several) if any(fields.values())), 0)
        found, values = frames[first], several[first]
        row, number_ = row_of(text, found.start()), found.group(2)
        missing = [part for part in _PARTS if part not in values]
        if missing:
            raise FileFormatError(
                "a part is missing", row=row, column=missing[0], expected="X, Y, Z, A, B, C"
            )
        name, load = _indexed(_NAME, text, number_), _indexed(_LOAD, text, number_)
        com = _COM.search(load.group(3)) if load else None
        inside = _fields(com.group(1), None) if com else {}
        return frame_of(
            name.group(2) if name else "tool",
            convention("ZYX").to_rotation(from_deg(np.array([values[p] for p in "ABC"]))),
            from_mm(np.array([values[p] for p in "XYZ"])),
            number(load.group(2)) if load else 0.0,
            from_mm(np.array([inside.get(p, 0.0) for p in "XYZ"])),
        )


def _indexed(pattern: re.Pattern[str], text: str, wanted: str | None) -> re.Match[str] | None:
    """The first match, of this tool's number where there is one."""
    found = list(pattern.finditer(text))
    same = [m for m in found if wanted is not None and m.group(1) == wanted]
    return (same or ([] if wanted is not None and any(m.group(1) for m in found) else found) or [None])[0]


def _real(text: str) -> str:
    """A number that is a REAL in KRL."""
    return text if "." in text else text + ".0"


def _aggregate(parts: str, values: list[str]) -> str:
    return "{" + ",".join(f"{part} {_real(value)}" for part, value in zip(parts, values, strict=True)) + "}"


def _fields(body: str, row: int | None) -> dict[str, float]:
    out: dict[str, float] = {}
    for part in body.split(","):
        words = part.split()
        if len(words) == 2 and words[0].upper() in _PARTS:
            out[words[0].upper()] = number(words[1], row, words[0])
    return out


FORMAT = KukaKrl()
