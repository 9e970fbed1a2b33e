"""ABB RAPID: `PERS tooldata torch := [TRUE, [[x,y,z],[q1,q2,q3,q4]], [mass,[x,y,z],[1,0,0,0],0,0,0]];`

Millimetres, quaternion w first, kilograms. An unknown mass is written as -1, as the controller itself marks a load that
has not been identified: it loads the module and asks for the mass before it moves. A tool that stands still (robhold
FALSE) has its frame in the world, not in the flange, and is refused. `tool0` is the controller's own bare flange.
"""

from __future__ import annotations

import re
from functools import partial

import numpy as np

from app.calibration.exchange._frame import (
    NUMBER,
    ToolFrame,
    frame_of,
    number,
    unit_quaternion,
    without_comments,
    written,
    written_mm,
)
from app.calibration.exchange._tools import Reader, Rows, Tool, all_zero
from app.errors import FileFormatError
from app.geometry import rotation_from_quaternion
from app.units import from_mm

_START = re.compile(r"\btooldata\s+(\w{1,64})\s*:=\s*\[", re.IGNORECASE)
_NUMBERS = re.compile(NUMBER)
_SHAPE = "[TRUE,[[x,y,z],[q1,q2,q3,q4]],[mass,[x,y,z],[1,0,0,0],0,0,0]]"


#: The longest declaration of one tool [characters]; what stands behind it is no part of it.
_LONGEST = 2000


class AbbRapid(Reader):
    key = "abb_rapid"
    title = "ABB RAPID tooldata"
    suffix = ".mod"
    suffixes = (".mod", ".modx", ".sys", ".sysx", ".prg")
    lacks = "it declares no tooldata"
    absent = "a declaration PERS tooldata name:=" + _SHAPE

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

    def tools(self, text: str) -> list[Tool]:
        text = without_comments(text, "!")
        rows = Rows(text)
        found = []
        starts = [*_START.finditer(text)]
        ends = [*(start.start() for start in starts[1:]), len(text)]
        for start, end in zip(starts, ends, strict=False):  # without a start there is one end too many
            body = text[start.end() : min(start.end() + _LONGEST, end)].partition(";")[0]
            numbers = tuple(_NUMBERS.findall(body))
            name, row = start.group(1), rows(start.start())
            bare = len(numbers) > 6 and all_zero([*numbers[:3], *numbers[4:7]])
            make = partial(_frame, name, row, body, numbers)
            found.append(Tool(name, 0, row, numbers, bare, make, name.lower() == "tool0"))
        return found


def _frame(name: str, row: int, body: str, numbers: tuple[str, ...]) -> ToolFrame:
    if body.lstrip().upper().startswith("FALSE"):
        raise FileFormatError(
            "the tool stands still (robhold FALSE): its frame is not the flange's",
            row=row,
            column=name,
            expected="TRUE",
        )
    values = [number(found, row, name) for found in numbers[:11]]
    if len(values) < 7:
        raise FileFormatError(f"{len(values)} numbers", row=row, column=name, expected=_SHAPE)
    mass, com = (values[7], from_mm(np.array(values[8:11]))) if len(values) >= 11 else (0.0, None)
    rotation = rotation_from_quaternion(unit_quaternion(values[3:7]))
    return frame_of(name, rotation, from_mm(np.array(values[:3])), mass, com)


FORMAT = AbbRapid()
