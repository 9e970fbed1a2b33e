"""CSV: one tool a row, units in the column names; quaternion w first."""

from __future__ import annotations

import csv
import io
from functools import partial

import numpy as np

from app.calibration.exchange._frame import (
    ToolFrame,
    frame_of,
    number,
    unit_quaternion,
    written,
    written_mm,
)
from app.calibration.exchange._tools import Reader, Tool, all_zero
from app.errors import FileFormatError
from app.geometry import rotation_from_quaternion
from app.units import from_mm

_NEEDED = ("x_mm", "y_mm", "z_mm", "qw", "qx", "qy", "qz")
_COLUMNS = ("name", *_NEEDED, "mass_kg", "com_x_mm", "com_y_mm", "com_z_mm")


#: The header row stands within so many characters.
_HEAD = 10_000


class CsvFrame(Reader):
    key = "csv"
    title = "CSV"
    suffix = ".csv"
    suffixes = ()
    lacks = "it has no row"
    absent = "one tool a row: " + ", ".join(_COLUMNS)

    def knows(self, text: str) -> bool:
        return any(line.startswith("name,x_mm,") for line in text[:_HEAD].splitlines()[:20])

    def write(self, frame: ToolFrame) -> str:
        q = [written(v, 12) for v in frame.pose.quaternion]
        load = [written(frame.mass), *written_mm(np.array(frame.com))]
        row = [frame.name, *written_mm(frame.pose.position), *q, *load]
        return "# kind: tool\n" + ",".join(_COLUMNS) + "\n" + ",".join(row) + "\n"

    def tools(self, text: str) -> list[Tool]:
        lines = text.splitlines()
        start = next((i for i, line in enumerate(lines) if line.strip() and not line.startswith("#")), None)
        if start is None:
            raise FileFormatError("no header row", row=1, expected=", ".join(_COLUMNS))
        try:
            rows = list(csv.reader(io.StringIO("\n".join(lines[start:]))))
        except csv.Error as error:
            raise FileFormatError(f"cannot be read ({error})", row=start + 1, expected="CSV") from None
        header = [cell.strip() for cell in rows[0]]
        for name in _NEEDED:
            if name not in header:
                raise FileFormatError("this column is missing", row=start + 1, column=name, expected="it")
        if len(rows) < 2 or len(rows[1]) != len(header):
            raise FileFormatError(
                "no whole row below the header", row=start + 2, expected=f"{len(header)} cells"
            )
        tools = []
        for row, cells in enumerate(rows[1:], start + 2):
            if len(cells) != len(header):
                continue  # an empty line, or one cut short
            named = dict(zip(header, cells, strict=True))
            turned = [named[n] for n in (*_NEEDED[:3], *_NEEDED[4:])]
            name = named.get("name", "").strip()
            tools.append(Tool(name, 0, row, tuple(cells), all_zero(turned), partial(_frame, named, row)))
        return tools


def _frame(cells: dict[str, str], row: int) -> ToolFrame:
    def value(name: str) -> float:
        text = cells.get(name, "").strip()
        return number(text, row, name) if text or name in _NEEDED else 0.0

    position = from_mm(np.array([value(n) for n in _NEEDED[:3]]))
    q = unit_quaternion([value(n) for n in _NEEDED[3:]])
    com = from_mm(np.array([value(f"com_{a}_mm") for a in "xyz"]))
    name = cells.get("name", "").strip() or "tool"
    return frame_of(name, rotation_from_quaternion(q), position, value("mass_kg"), com)


FORMAT = CsvFrame()
