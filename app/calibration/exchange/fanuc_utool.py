"""FANUC: a TP program (.LS) that sets a user tool; mm, degrees W, P, R about fixed axes.

A controller loads an .LS, but never the listing of its own variables (sysframe.va). A TP program cannot write a frame
from numbers: the frame stands in the program as a position, goes to a position register and from there to UTOOL. It
carries three decimals, as the controller itself shows and stores in text.

Read are such programs (also those that fill the register number by number), and listings of $MNUTOOL. Positions of a
motion program, position registers and user frames are never a tool.
"""

from __future__ import annotations

import bisect
import re
from functools import partial

import numpy as np

from app.calibration.exchange._frame import NUMBER, ToolFrame, frame_of, number
from app.calibration.exchange._tools import Reader, Rows, Tool, all_zero
from app.errors import FileFormatError
from app.geometry import convention
from app.units import deg, from_deg, from_mm, mm

_PARTS = "XYZWPR"
_GAP = r"\s*[:=]\s*(" + NUMBER + r")\s*(?:(?:mm|deg)\s*)?(?:,\s*)?"
_FRAME = re.compile("".join(rf"\b{part}{_GAP}" for part in _PARTS))
#: One step of a program: remarks, the tool that is set, a register that gets a position or one number.
_STEP = re.compile(
    r"(?P<remark>!tool[ \t]{1,9}(?P<name>\w{1,64})|(?://|!)[^\n]*)"
    r"|\bUTOOL\s*\[\s*(?P<tool>\d{1,4})[^\]\n]{0,40}\]\s*=\s*PR\s*\[\s*(?P<set>\d{1,5})"
    r"|\bPR\s*\[\s*(?P<to>\d{1,5})\s*(?::[^\]\n]{0,40})?\]\s*=\s*P\s*\[\s*(?P<position>\d{1,5})"
    r"|\bPR\s*\[\s*(?P<register>\d{1,5})\s*,\s*(?P<part>[1-6])\s*(?::[^\]\n]{0,40})?\]\s*=\s*(?:\(\s*)?(?P<value>"
    + NUMBER
    + ")"
)
_POSITION = re.compile(r"^[ \t]{0,40}P\[\s*(\d{1,5})\s*(?::[^\]\n]{0,40})?\]\s*\{", re.MULTILINE)
_SECTION = re.compile(r"\[\*\w{1,32}\*\]\s{0,9}(\$?\w{1,32})")
_ENTRY = re.compile(r"\[\s*1\s*,\s*(\d{1,4})\s*\]\s*=")
_COMMENT = re.compile(r"'([^'\n]{1,40})'")
_PROGRAM = re.compile(r"\bUTOOL\s*\[[^\]\n]{0,40}\]\s*=")
_WHOSE = re.compile(r"^[ \t]{0,40}/PROG\b|\[\*\w{1,32}\*\]", re.MULTILINE)
#: A position with its configuration stands within so many characters.
_BLOCK = 1000
#: The last register of most controllers; what stood in it is lost, the program says so.
_REGISTER = 100


class FanucUtool(Reader):
    key = "fanuc_utool"
    title = "FANUC UTOOL"
    suffix = ".ls"
    suffixes = (".ls", ".va", ".tp")
    lacks = "it sets no UTOOL"
    absent = "a program that sets UTOOL[n]=PR[…], or a listing of $MNUTOOL (X: … Y: … Z: … W: … P: … R: …)"

    def knows(self, text: str) -> bool:
        return bool(_WHOSE.search(text) or _PROGRAM.search(text) or _FRAME.search(text))

    def write(self, frame: ToolFrame) -> str:
        x, y, z = mm(frame.pose.position)
        w, p, r = deg(convention("XYZ").from_rotation(frame.pose.rotation))
        lines = [
            f"!tool {frame.name}",
            f"!overwrites PR {_REGISTER}, UTOOL 1",
            f"PR[{_REGISTER}]=P[1]",
            f"UTOOL[1]=PR[{_REGISTER}]",
        ]
        body = "\n".join(f"{i:>4}:  {line} ;" for i, line in enumerate(lines, 1))
        return (
            "/PROG  SETTOOL\n/ATTR\n"
            "OWNER\t\t= MNEDITOR;\n"
            f'COMMENT\t\t= "{frame.name[:16]}";\n'
            "PROG_SIZE\t= 0;\n"
            f"LINE_COUNT\t= {len(lines)};\n"
            "MEMORY_SIZE\t= 0;\n"
            "PROTECT\t\t= READ_WRITE;\n"
            "TCD:  STACK_SIZE\t= 0,\n      TASK_PRIORITY\t= 50,\n      TIME_SLICE\t= 0,\n"
            "      BUSY_LAMP_OFF\t= 0,\n      ABORT_REQUEST\t= 0,\n      PAUSE_REQUEST\t= 0;\n"
            "DEFAULT_GROUP\t= 1,*,*,*,*;\n"
            "CONTROL_CODE\t= 00000000 00000000;\n"
            f"/MN\n{body}\n"
            "/POS\nP[1]{\n   GP1:\n"
            "\tUF : 0, UT : 1,\t\tCONFIG : 'N U T, 0, 0, 0',\n"
            f"\tX = {_three(x)}  mm,\tY = {_three(y)}  mm,\tZ = {_three(z)}  mm,\n"
            f"\tW = {_three(w)} deg,\tP = {_three(p)} deg,\tR = {_three(r)} deg\n"
            "};\n/END\n"
        )

    def tools(self, text: str) -> list[Tool]:
        return _program(text) if _PROGRAM.search(text) else _listing(text)


def _program(text: str) -> list[Tool]:
    """Tools in the order in which the program sets them, each with what its register held by then."""
    rows = Rows(text)
    positions = {
        found.group(1): _FRAME.search(text, found.end(), found.end() + _BLOCK)
        for found in _POSITION.finditer(text)
    }
    registers: dict[str, dict[str, str]] = {}
    tools, name = [], ""
    for step in _STEP.finditer(text):
        part = step.groupdict()
        if part["remark"]:
            name = part["name"] or name
        elif part["position"]:
            held = positions.get(part["position"])
            registers[part["to"]] = {} if held is None else dict(zip("123456", held.groups(), strict=True))
        elif part["register"]:
            registers[part["register"]] = {**registers.get(part["register"], {}), part["part"]: part["value"]}
        else:
            numbers = registers.get(part["set"], {})
            written, row = tuple(numbers.get(k, "") for k in "123456"), rows(step.start())
            bare = len(numbers) == len(_PARTS) and all_zero(written)
            make = partial(_frame, name or "tool", row, written, part["set"])
            tools.append(Tool(name, int(part["tool"]), row, written, bare, make))
            name = ""
    return tools


def _listing(text: str) -> list[Tool]:
    """Tools of a listing of variables; one without any headline holds tools alone."""
    headlines = [*_SECTION.finditer(text)]
    ends = [*(found.start() for found in headlines[1:]), len(text)]
    parts = (
        [
            (found.end(), end)
            for found, end in zip(headlines, ends, strict=True)
            if found.group(1).upper() == "$MNUTOOL"
        ]
        if headlines
        else ([] if _WHOSE.search(text) else [(0, len(text))])
    )
    rows = Rows(text)
    tools = []
    for start, end in parts:
        entries = [*_ENTRY.finditer(text, start, end)]
        places = [found.start() for found in entries]
        before = start
        for found in _FRAME.finditer(text, start, end):
            at = bisect.bisect_right(places, found.start()) - 1
            said = _COMMENT.search(text, max(before, places[at] if at >= 0 else before), found.start())
            name, row = said.group(1).strip() if said else "", rows(found.start())
            number_ = int(entries[at].group(1)) if at >= 0 else 0
            written = found.groups()
            make = partial(_frame, name or "tool", row, written, "")
            tools.append(Tool(name, number_, row, written, all_zero(written), make))
            before = found.end()
    return tools


def _frame(name: str, row: int, written: tuple[str, ...], register: str) -> ToolFrame:
    if not all(written):
        raise FileFormatError(
            f"PR[{register}] is not filled with a whole frame",
            row=row,
            column="UTOOL",
            expected="P[…] with X, Y, Z, W, P, R, or PR[…,1] to PR[…,6]",
        )
    values = np.array([number(text, row) for text in written])
    rotation = convention("XYZ").to_rotation(from_deg(values[3:]))
    try:
        return frame_of(name, rotation, from_mm(values[:3]))
    except FileFormatError as error:
        raise FileFormatError(error.problem, row=row, column="X … R", expected=error.expected) from None


FORMAT = FanucUtool()


def _three(value: float) -> str:
    return f"{np.round(value, 3) + 0.0:9.3f}"
