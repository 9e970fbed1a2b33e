"""FANUC: a TP program (.LS) that sets a user tool; mm, degrees W, P, R about fixed axes.

A controller loads an .LS, but never the listing of its own variables (sysframe.va). A TP program cannot write a frame
from numbers: the frame stands in the program as a position, goes to a position register and from there to UTOOL. It
carries three decimals, as the controller itself shows and stores in text.

Read are such programs (also those that fill the register number by number), and listings of $MNUTOOL; of several
tools the first that is not the bare flange.
"""

from __future__ import annotations

import re

import numpy as np

from app.calibration.exchange._frame import NUMBER, ToolFrame, frame_of, number, row_of
from app.errors import FileFormatError
from app.geometry import convention
from app.units import deg, from_deg, from_mm, mm

_PARTS = "XYZWPR"
_GAP = r"\s*[:=]\s*(" + NUMBER + r")\s*(?:(?:mm|deg)\s*)?(?:,\s*)?"
_FRAME = re.compile("".join(rf"\b{part}{_GAP}" for part in _PARTS))
_LISTED = re.compile(r"\$MNUTOOL\b")
_OTHER = re.compile(r"\[\*SYSTEM\*\]")
_SET = re.compile(r"\bUTOOL\s*\[[^\]]*\]\s*=\s*PR\s*\[\s*(\d+)")
_COPIED = r"\bPR\s*\[\s*{register}\s*(?::[^\]]*)?\]\s*=\s*P\s*\[\s*(\d+)"
_PART = r"\bPR\s*\[\s*{register}\s*,\s*([1-6])\s*(?::[^\]]*)?\]\s*=\s*\(?\s*(" + NUMBER + r")"
_NAME = re.compile(
    r"\$TOOLNAME.*?'([^'\n]*)'|Comment:\s*'([^'\n]*)'|^[ \t]*(?:\d+[ \t]*)?:\s*!tool (\w+)", re.MULTILINE
)
#: The last register of most controllers; what stood in it is lost, the program says so.
_REGISTER = 100


class FanucUtool:
    key = "fanuc_utool"
    title = "FANUC UTOOL"
    suffix = ".ls"

    def knows(self, text: str) -> bool:
        return bool(_SET.search(text)) or bool(_LISTED.search(text) or _FRAME.search(text))

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

    def read(self, text: str) -> ToolFrame:
        values, row = self._program(text) if _SET.search(text) else self._listing(text)
        named = _NAME.search(text)
        name = next((g for g in named.groups() if g), "tool") if named else "tool"
        rotation = convention("XYZ").to_rotation(from_deg(values[3:]))
        try:
            return frame_of(name, rotation, from_mm(values[:3]))
        except FileFormatError as error:
            raise FileFormatError(error.problem, row=row, column="X … R", expected=error.expected) from None

    def _program(self, text: str) -> tuple[np.ndarray, int]:
        start = _SET.search(text)
        assert start is not None
        register, row = start.group(1), row_of(text, start.start())
        copied = re.search(_COPIED.format(register=register), text[: start.start()])
        if copied:
            block = re.search(rf"\bP\[\s*{copied.group(1)}\s*(?::[^\]]*)?\]\s*\{{(.*?)\}}", text, re.DOTALL)
            found = _FRAME.search(block.group(1)) if block else None
            if found and block:
                return _numbers(found.groups(), row_of(text, block.start())), row
        parts = dict(re.findall(_PART.format(register=register), text[: start.start()]))
        if len(parts) == len(_PARTS):
            return _numbers([parts[str(k + 1)] for k in range(len(_PARTS))], row), row
        raise FileFormatError(
            f"PR[{register}] is not filled with a whole frame",
            row=row,
            column="UTOOL",
            expected="P[…] with X, Y, Z, W, P, R, or PR[…,1] to PR[…,6]",
        )

    def _listing(self, text: str) -> tuple[np.ndarray, int]:
        listed = _LISTED.search(text)
        start = listed.end() if listed else 0
        following = _OTHER.search(text, start) if listed else None
        end = following.start() if following else len(text)
        frames = list(_FRAME.finditer(text, start, end))
        if not frames:
            raise FileFormatError("no tool frame", row=1, expected="X: … Y: … Z: … W: … P: … R: …")
        values = [_numbers(f.groups(), row_of(text, f.start())) for f in frames]
        first = next((k for k, v in enumerate(values) if np.any(v)), 0)
        return values[first], row_of(text, frames[first].start())


FORMAT = FanucUtool()


def _numbers(texts: list[str] | tuple[str, ...], row: int) -> np.ndarray:
    return np.array([number(text, row) for text in texts])


def _three(value: float) -> str:
    return f"{np.round(value, 3) + 0.0:9.3f}"
