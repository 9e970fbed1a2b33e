"""KUKA KRL: a program that stores the tool as number 1; mm, degrees, Z-Y-X.

    TOOL_DATA[1]={X 119.5,Y 0.0,Z 352.0,A 0.0,B 54.3,C 0.0}

Lines stand in a DEF … END, without which no controller takes a .src; reals have their decimal point. Read are `$TOOL=`,
`TOOL_DATA[n]=` (as in $config.dat) and those FRAMEs that the program makes its tool (`$TOOL=name`) or that are called
one; other frames are bases and places, never a tool.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import partial

import numpy as np

from app.calibration.exchange._frame import (
    NUMBER,
    ToolFrame,
    frame_of,
    number,
    without_comments,
    written,
    written_mm,
)
from app.calibration.exchange._tools import Reader, Rows, Tool, all_zero
from app.errors import FileFormatError
from app.geometry import convention
from app.units import deg, from_deg, from_mm

_FRAME = re.compile(
    r"(?:(\$TOOL)|TOOL_DATA\s*\[\s*(\d{1,4})\s*\]|\bFRAME\s+(\w{1,64}))\s*=\s*\{(?:\s*FRAME\s*:)?([^{}]{0,400})\}",
    re.IGNORECASE,
)
_NAME = re.compile(r"TOOL_NAME\s*\[\s*(\d{1,4})\s*(?:,\s*)?\]\s*=\s*\"([^\"\n]{0,80})\"", re.IGNORECASE)
_LOAD = re.compile(
    r"LOAD(?:_DATA\s*\[\s*(\d{1,4})\s*\])?\s*=\s*\{\s*M\s+(" + NUMBER + r")([^\n]{0,400})", re.IGNORECASE
)
_USED = re.compile(r"\$TOOL\s*=\s*(\w{1,64})\b(?!\s*\[)", re.IGNORECASE)
_MAYBE = re.compile(r"\$TOOL|TOOL_DATA|\bFRAME\b", re.IGNORECASE)
_CALLED = re.compile(r"tool|tcp", re.IGNORECASE)
_COM = re.compile(r"CM\s*\{([^{}]{0,200})\}", re.IGNORECASE)
_PARTS = "XYZABC"


class KukaKrl(Reader):
    key = "kuka_krl"
    title = "KUKA KRL $TOOL"
    suffix = ".src"
    suffixes = (".src", ".dat", ".sub")
    lacks = "it sets no $TOOL and no TOOL_DATA"
    absent = "$TOOL= or TOOL_DATA[n]={X …,Y …,Z …,A …,B …,C …}"

    def knows(self, text: str) -> bool:
        return bool(self.tools(text))

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

    def tools(self, text: str) -> list[Tool]:
        if not _MAYBE.search(text):
            return []
        text = without_comments(text, ";")
        rows = Rows(text)
        names = {found.group(1): found.group(2) for found in reversed([*_NAME.finditer(text)])}
        loads = {found.group(1): found for found in reversed([*_LOAD.finditer(text)])}
        used = {found.group(1).lower() for found in _USED.finditer(text)}
        tools = []
        for found in _FRAME.finditer(text):
            active, index, called, body = found.groups()
            if called is not None and called.lower() not in used and not _CALLED.search(called):
                continue
            name = names.get(index, "") if active is None else next(iter(names.values()), "")
            load = loads.get(index) or loads.get(None)
            row, parts = rows(found.start()), tuple(part.strip() for part in body.split(","))
            bare = all_zero(part[1:] for part in parts)
            make = partial(_frame, called or name or "tool", row, parts, load)
            predefined = (called or "").upper() == "NULLFRAME"
            tools.append(Tool(called or name, int(index or 0), row, parts, bare, make, predefined))
        return tools


def _frame(name: str, row: int, parts: tuple[str, ...], load: re.Match[str] | None) -> ToolFrame:
    values = _fields(parts, row)
    missing = [part for part in _PARTS if part not in values]
    if missing:
        raise FileFormatError("a part is missing", row=row, column=missing[0], expected="X, Y, Z, A, B, C")
    com = _COM.search(load.group(3)) if load else None
    inside = _fields(com.group(1).split(","), None) if com else {}
    return frame_of(
        name,
        convention("ZYX").to_rotation(from_deg(np.array([values[p] for p in "ABC"]))),
        from_mm(np.array([values[p] for p in "XYZ"])),
        number(load.group(2)) if load else 0.0,
        from_mm(np.array([inside.get(p, 0.0) for p in "XYZ"])),
    )


def _real(text: str) -> str:
    """A number that is a REAL in KRL."""
    return text if "." in text else text + ".0"


def _aggregate(parts: str, values: list[str]) -> str:
    return "{" + ",".join(f"{part} {_real(value)}" for part, value in zip(parts, values, strict=True)) + "}"


def _fields(parts: Iterable[str], row: int | None) -> dict[str, float]:
    out: dict[str, float] = {}
    for part in parts:
        words = part.split()
        if len(words) == 2 and words[0].upper() in _PARTS:
            out[words[0].upper()] = number(words[1], row, words[0])
    return out


FORMAT = KukaKrl()
