"""CSV: one tool a row, units in the column names; quaternion w first."""

from __future__ import annotations

import csv
import io

import numpy as np

from app.calibration.exchange._frame import (
    ToolFrame,
    frame_of,
    number,
    unit_quaternion,
    written,
    written_mm,
)
from app.errors import FileFormatError
from app.geometry import rotation_from_quaternion
from app.units import from_mm

_NEEDED = ("x_mm", "y_mm", "z_mm", "qw", "qx", "qy", "qz")
_COLUMNS = ("name", *_NEEDED, "mass_kg", "com_x_mm", "com_y_mm", "com_z_mm")


class CsvFrame:
    key = "csv"
    title = "CSV"
    suffix = ".csv"

    def knows(self, text: str) -> bool:
        return any(line.startswith("name,x_mm,") for line in text.splitlines()[:20])

    def write(self, frame: ToolFrame) -> str:
        q = [written(v, 12) for v in frame.pose.quaternion]
        load = [written(frame.mass), *written_mm(np.array(frame.com))]
        row = [frame.name, *written_mm(frame.pose.position), *q, *load]
        return "# kind: tool\n" + ",".join(_COLUMNS) + "\n" + ",".join(row) + "\n"

    def read(self, text: str) -> ToolFrame:
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
        cells = dict(zip(header, rows[1], strict=True))

        def value(name: str) -> float:
            text = cells.get(name, "").strip()
            return number(text, start + 2, name) if text or name in _NEEDED else 0.0

        position = from_mm(np.array([value(n) for n in _NEEDED[:3]]))
        q = unit_quaternion([value(n) for n in _NEEDED[3:]])
        com = from_mm(np.array([value(f"com_{a}_mm") for a in "xyz"]))
        name = cells.get("name", "").strip() or "tool"
        return frame_of(name, rotation_from_quaternion(q), position, value("mass_kg"), com)


FORMAT = CsvFrame()
