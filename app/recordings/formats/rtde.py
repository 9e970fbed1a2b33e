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

from app.errors import FileFormatError
from app.recordings.delimited.header import Header, read_header
from app.recordings.delimited.rows import MOST_EMPTY, parts, whole_lines
from app.recordings.delimited.source import Source, open_source
from app.recordings.formats._frames import table_of
from app.recordings.options import ReadOptions
from app.recordings.table import Table

_HEAD = 65536
#: RTDE name -> quantity and unit.
NAMES = {
    "actual_q": ("q", "rad"),
    "actual_qd": ("qd", "rad_s"),
    "target_q": ("qc", "rad"),
    "actual_current": ("i", "A"),
    "actual_current_as_torque": ("tau", "Nm"),
    "joint_temperatures": ("temperature", "degC"),
}
_NAME = re.compile(r'[^\s,;"]+')


class Rtde:
    key = "rtde"
    title = "CSV recorded over Universal Robots' RTDE"

    def matches(self, path: Path, head: bytes) -> bool:
        if not path.is_file() or b"actual_q_0" not in head:
            return False
        lines = head.decode("utf-8", errors="replace").replace("\r", "\n").split("\n")
        header = next((line for line in lines if "actual_q_0" in line), "")
        return "timestamp" in _NAME.findall(header)

    def read(self, path: Path, options: ReadOptions | None = None) -> Table:
        """Reads all of it. A variable that was asked for twice counts once.

        Raises:
            FileFormatError: rows that do not fit the header, or not text.
        """
        with path.open("rb") as file:
            source = open_source(path, file.read(_HEAD))
        header = read_header(source)
        mark = next((m for m in (",", ";", "\t") if m in header.text), None)
        names = [name.strip().strip('"') for name in header.text.split(mark) if name.strip()]
        frame, rows = _frame(source, header, names, mark)
        keys: dict[str, Any] = {"kind": "motion", **header.keys, "__header_row__": header.row}
        table = table_of(path, keys, _columns(frame, path))
        body = table.load()[0]
        return Table(path, keys, table.names, lambda: (body, rows))


def _frame(
    source: Source, header: Header, names: list[str], mark: str | None
) -> tuple[pl.DataFrame, np.ndarray]:
    """The numbers, one column for each different name, and the lines they stood on; a row that does not fit the header
    is empty."""
    wanted = {name: names.index(name) for name in ("timestamp", *_taken()) if name in names}
    columns: dict[str, list[np.ndarray]] = {name: [] for name in wanted}
    rows: list[np.ndarray] = []
    good = bad = 0
    for first, piece in whole_lines(source, header.offset, header.row + 1):
        for number, part in parts(piece, first):
            lines = part.split(b"\n")
            kept = [k for k, line in enumerate(lines) if line and not line.isspace()]
            cells, fits = _cells([lines[k] for k in kept], len(names), mark)
            good, bad = good + sum(fits), bad + len(lines) - sum(fits)
            if bad > MOST_EMPTY and bad > good:
                raise FileFormatError(
                    f"over {MOST_EMPTY} rows that do not fit the header",
                    file=source.path,
                    row=number,
                    expected=f"{len(names)} values a row",
                )
            rows.append(number + np.array(kept, int))
            where = np.flatnonzero(fits)
            for name, at in wanted.items():
                column = np.full(len(kept), np.nan)
                column[where] = _numbers(pl.Series([row[at] for row in cells], dtype=pl.String))
                columns[name].append(column)
    if not good:
        raise FileFormatError(
            "no row fits the header",
            file=source.path,
            row=header.row + 1,
            expected=f"{len(names)} values a row",
        )
    return pl.DataFrame({n: np.concatenate(v) for n, v in columns.items()}), np.concatenate(rows)


def _cells(lines: list[bytes], width: int, mark: str | None) -> tuple[list[list[str]], list[bool]]:
    """The cells of those lines that have as many as the header, and which lines these are."""
    split = [line.decode("utf-8").split(mark) for line in lines]
    fits = [len(cells) == width for cells in split]
    return [cells for cells, good in zip(split, fits, strict=True) if good], fits


def _taken() -> list[str]:
    return [f"{rtde}_{j}" for rtde in NAMES for j in range(6)]


def _columns(frame: pl.DataFrame, path: Path) -> dict[str, np.ndarray]:
    if "timestamp" not in frame.columns:
        raise FileFormatError(
            "no time in this log", file=path, column="timestamp", expected="cells parted by one sign"
        )
    out = {"t_s": frame["timestamp"].to_numpy()}
    for rtde, (quantity, unit) in NAMES.items():
        for j in range(6):
            if f"{rtde}_{j}" in frame.columns:
                out[f"{quantity}{j + 1}_{unit}"] = frame[f"{rtde}_{j}"].to_numpy()
    if "q6_rad" not in out:
        raise FileFormatError(
            "positions of six joints are not in this log",
            file=path,
            column="actual_q_5",
            expected="actual_q_0 to actual_q_5",
        )
    return out


def _numbers(series: pl.Series) -> np.ndarray:
    text = series.str.strip_chars().str.replace(r"^([+-]?\d*),(\d+)", "$1.$2")
    return text.cast(pl.Float64, strict=False).to_numpy().astype(float)


FORMAT = Rtde()
