"""ABB RAPID: `PERS tooldata torch := [TRUE, [[x,y,z],[q1,q2,q3,q4]], [mass,[x,y,z],[1,0,0,0],0,0,0]];`

Millimetres, quaternion w first, kilograms. An unknown mass is written as -1, as the controller itself marks a load that
has not been identified: it loads the module and asks for the mass before it moves. A tool that stands still (robhold
FALSE) has its frame in the world, not in the flange, and is refused.
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
    unit_quaternion,
    without_comments,
    written,
    written_mm,
)
from app.errors import FileFormatError
from app.geometry import rotation_from_quaternion
from app.units import from_mm

_START = re.compile(r"\btooldata\s+(\w+)\s*:=\s*\[", re.IGNORECASE)
_NUMBERS = re.compile(NUMBER)
_SHAPE = "[TRUE,[[x,y,z],[q1,q2,q3,q4]],[mass,[x,y,z],[1,0,0,0],0,0,0]]"


class AbbRapid:
    key = "abb_rapid"
    title = "ABB RAPID tooldata"
    suffix = ".mod"

    def knows(self, text: str) -> bool:
        return _START.search(without_comments(text, "!")) is not None

    def write(self, frame: ToolFrame) -> str:
        position = ",".join(written_mm(frame.pose.position))
        q = ",".join(written(v, 12) for v in frame.pose.quaternion)
        mass = written(frame.mass) if frame.mass > 0 else "-1"
        com = ",".join(written_mm(np.array(frame.com)))
        return (
            "MODULE teachframe_tool\n"
            f"  PERS tooldata {frame.name}:=[TRUE,[[{position}],[{q}]],[{mass},[{com}],[1,0,0,0],0,0,0]];\n"
            "ENDMODULE\n"
        )

    def read(self, text: str) -> ToolFrame:
        text = without_comments(text, "!")
        start = _START.search(text)
        if not start:
            raise FileFormatError("no tooldata", row=1, expected="PERS tooldata name:=" + _SHAPE)
        row = row_of(text, start.start())
        body = text[start.end() :].partition(";")[0]
        if body.lstrip().upper().startswith("FALSE"):
            raise FileFormatError(
                "the tool stands still (robhold FALSE): its frame is not the flange's",
                row=row,
                column=start.group(1),
                expected="TRUE",
            )
        values = [number(found, row) for found in _NUMBERS.findall(body)]
        if len(values) < 7:
            raise FileFormatError(f"{len(values)} numbers", row=row, column=start.group(1), expected=_SHAPE)
        mass, com = (values[7], from_mm(np.array(values[8:11]))) if len(values) >= 11 else (0.0, None)
        rotation = rotation_from_quaternion(unit_quaternion(values[3:7]))
        return frame_of(start.group(1), rotation, from_mm(np.array(values[:3])), mass, com)


FORMAT = AbbRapid()
