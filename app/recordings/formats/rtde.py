"""Logs of Universal Robots' real-time data exchange (RTDE): one header row of RTDE names, spaces or commas.

Angles are radians and currents amperes by the maker's definition; joints 0 to 5 become 1 to 6. Torques are
taken where the controller gives them (`actual_current_as_torque`); `target_moment` is what its own model
predicts, and is never taken for a measurement.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import yaml

from app.errors import FileFormatError
from app.recordings.formats._frames import table_of
from app.recordings.table import Table

#: RTDE name -> quantity and unit.
NAMES = {
    "actual_q": ("q", "rad"),
    "actual_qd": ("qd", "rad_s"),
    "target_q": ("qc", "rad"),
    "actual_current": ("i", "A"),
    "actual_current_as_torque": ("tau", "Nm"),
    "joint_temperatures": ("temperature", "degC"),
}
_HEADER = re.compile(rb"^(?:\xef\xbb\xbf)?\"?timestamp\"?[ ,;\t]", re.MULTILINE)


class Rtde:
    key = "rtde"
    title = "CSV recorded over Universal Robots' RTDE"

    def matches(self, path: Path, head: bytes) -> bool:
        return path.is_file() and b"actual_q_0" in head and bool(_HEADER.search(head))

    def read(self, path: Path) -> Table:
        """Reads all of it.

        Raises:
            FileFormatError: rows that do not fit the header, or not text.
        """
        keys: dict[str, Any] = {"kind": "motion"}
        try:
            lines = path.read_text(encoding="utf-8-sig").splitlines()
        except UnicodeDecodeError:
            raise FileFormatError("not UTF-8 text", file=path, expected="an RTDE log") from None
        at = 0
        while at < len(lines) and (lines[at].startswith("#") or not lines[at].strip()):
            _key(lines[at], keys)
            at += 1
        header = lines[at]
        mark = next((m for m in (",", ";", "\t") if m in header), " ")
        names = [name.strip().strip('"') for name in header.split(mark) if name.strip()]
        rows = [line for line in lines[at + 1 :] if line.strip()]
        cells = [line.split(mark) if mark != " " else line.split() for line in rows]
        good = np.array([len(row) == len(names) for row in cells], bool)
        if not good.any():
            raise FileFormatError(
                "no row fits the header", file=path, row=at + 2, expected=f"{len(names)} values a row"
            )
        empty = [""] * len(names)
        frame = pl.DataFrame(
            [row if fits else empty for row, fits in zip(cells, good, strict=True)],
            schema=dict.fromkeys(names, pl.String),
            orient="row",
        )
        keys["__header_row__"] = at + 1
        table = table_of(path, keys, _columns(frame, path))
        first = at + 2
        body = table.load()[0]
        return Table(path, keys, table.names, lambda: (body, np.arange(first, first + len(body))))


def _columns(frame: pl.DataFrame, path: Path) -> dict[str, np.ndarray]:
    out = {"t_s": _numbers(frame["timestamp"])}
    for rtde, (quantity, unit) in NAMES.items():
        for j in range(6):
            if f"{rtde}_{j}" in frame.columns:
                out[f"{quantity}{j + 1}_{unit}"] = _numbers(frame[f"{rtde}_{j}"])
    if "q6_rad" not in out:
        raise FileFormatError(
            "positions of six joints are not in this log",
            file=path,
            column="actual_q_5",
            expected="actual_q_0 to actual_q_5",
        )
    return out


def _numbers(series: pl.Series) -> np.ndarray:
    return series.str.strip_chars().cast(pl.Float64, strict=False).to_numpy().astype(float)


def _key(line: str, keys: dict[str, Any]) -> None:
    match = re.match(r"^#\s*(\w+)\s*:\s?(.*)$", line)
    if match:
        try:
            keys[match.group(1)] = yaml.safe_load(match.group(2))
        except yaml.YAMLError:
            keys[match.group(1)] = match.group(2)


FORMAT = Rtde()
