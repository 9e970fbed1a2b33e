"""Flange poses as other programs save them, for points: matrices in rows of numbers, and ROS poses by their names.

Matrices: no header row; 16 numbers a line (or 12, without the last row), or four lines of four for each pose, row by
row; `#` lines may stand above. The unit of their translation is said by `# unit: mm` or --unit. Every row is a touch.
ROS: a header row with `position.x` … `orientation.w` (whatever stands before: `pose.pose.`, `field.`, `transform.`),
metres and quaternions by the messages' own definition; `role` may stand beside.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl

from app.errors import CellValueError, FileFormatError, UnitError
from app.geometry.rotation import quaternion_from_rotation
from app.recordings.delimited.header import add_key
from app.recordings.list_text import read_text
from app.recordings.options import ReadOptions
from app.recordings.point_lists import UNITS
from app.recordings.table import Table
from app.units import MM_PER_INCH, mm

_SIGNS = re.compile(r"[\s,;]+")
_NUMBERS = re.compile(r"[\s,;+\-.\deE]+\Z")
_LONGEST = 2000  # characters of a line of sixteen numbers, with all their digits
#: By which a rotation's columns may miss a right angle or their length: three digits are often all that is written.
_SQUARE = 1e-3
_ROS = {
    **{rf"(?:position|translation)[._]?{axis}": f"{axis}_m" for axis in "xyz"},
    **{rf"(?:orientation|rotation)[._]?{axis}": f"q{axis}" for axis in "xyzw"},
}
_NAMED = [(re.compile(rf"(?:.*[./_ ])?{pattern}\Z"), name) for pattern, name in _ROS.items()]


class PoseLists:
    key = "pose_lists"
    title = "4x4 matrices in rows, and ROS poses by their names"

    def matches(self, path: Path, head: bytes) -> bool:
        if not path.is_file() or b"\x00" in head:
            return False
        lines = _content(head.decode("utf-8-sig", errors="replace").splitlines()[:200])
        if not lines:
            return False
        first = lines[0][1]
        return _matrix_rows(lines[:4]) is not None or len(set(_ros_names(first).values())) == 7

    def read(self, path: Path, options: ReadOptions | None = None) -> Table:
        """Reads all of it.

        Raises:
            FileFormatError, CellValueError, UnitError: by row.
        """
        text = read_text(path).splitlines()
        keys: dict[str, Any] = {}
        for number, line in enumerate(text, 1):
            if line.lstrip().startswith("#"):
                add_key(line.strip(), keys, path, number)
        lines = _content(text)
        keys |= {"kind": "points", "angles": "quaternion", "__header_row__": lines[0][0]}
        if _ros_names(lines[0][1]):
            return _ros_table(path, lines, keys)
        return _matrix_table(path, lines, keys, options)


def _content(lines: list[str]) -> list[tuple[int, str]]:
    return [
        (k, line) for k, line in enumerate(lines, 1) if line.strip() and not line.lstrip().startswith("#")
    ]


def _cells(line: str) -> list[str]:
    return [cell for cell in _SIGNS.split(line.strip()) if cell]


def _matrix_rows(lines: list[tuple[int, str]]) -> int | None:
    """Numbers a line, where these are lines of matrices: 16, 12 or 4."""
    numeric = [len(_cells(line)) for _, line in lines if len(line) < _LONGEST and _NUMBERS.match(line)]
    if not numeric or not _NUMBERS.match(lines[0][1]):
        return None
    whole = numeric[0] in (16, 12)
    return numeric[0] if whole or numeric[:4] == [4, 4, 4, 4] else None


def _matrix_table(
    path: Path, lines: list[tuple[int, str]], keys: dict[str, Any], options: ReadOptions | None
) -> Table:
    width = _matrix_rows(lines[:4]) or 0
    unit = UNITS.get(str(keys.get("unit", "")).lower()) or (options.unit if options is not None else None)
    if unit is None:
        raise UnitError("no unit", file=path, row=1, expected="a header line '# unit: mm' or --unit")
    numbers, rows = [], []
    for k, line in lines:
        cells = _cells(line)
        if len(cells) != width:
            raise FileFormatError(
                f"{len(cells)} numbers", file=path, row=k, expected="numbers in rows of 16, 12, or 4"
            )
        try:
            numbers.append([float(cell) for cell in cells])
        except ValueError:
            raise CellValueError(
                f"found {line.strip()[:40]!r}", file=path, row=k, expected="numbers"
            ) from None
        rows.append(k)
    if width == 4:
        if len(numbers) % 4:
            raise FileFormatError(
                f"{len(numbers)} lines", file=path, row=rows[-1], expected="four lines for each pose"
            )
        numbers, rows = np.array(numbers).reshape(-1, 16).tolist(), rows[::4]
    matrices = np.array([row[:12] for row in numbers]).reshape(-1, 3, 4)
    turns = matrices[:, :, :3]
    off = np.abs(np.einsum("nij,nik->njk", turns, turns) - np.eye(3)).max(axis=(1, 2))
    wrong = np.flatnonzero(
        ~(off < _SQUARE) | (np.linalg.det(turns) < 0) | ~np.isfinite(matrices).all(axis=(1, 2))
    )
    if len(wrong):
        raise CellValueError(
            f"a rotation that is off by {off[wrong[0]]:.3g}",
            file=path, row=rows[int(wrong[0])], expected="a matrix whose axes are square",
        )  # fmt: skip
    scale = {"mm": 1.0, "m": mm(1.0), "in": MM_PER_INCH}[unit]
    columns = {f"{axis}_mm": matrices[:, k, 3] * scale for k, axis in enumerate("xyz")}
    quaternions = np.array([quaternion_from_rotation(turn) for turn in turns])
    columns |= {f"q{axis}": quaternions[:, k] for k, axis in enumerate("wxyz")}
    frame = pl.DataFrame({"role": ["touch"] * len(rows), **columns})
    lines_at = np.array(rows)
    return Table(path, keys, tuple(frame.columns), lambda: (frame, lines_at))


def _ros_names(header: str) -> dict[str, str]:
    """Name in the file -> our column."""
    names = [cell.strip().strip('"') for cell in re.split(r"[,;\t]", header)]
    return {name: ours for name in names for pattern, ours in _NAMED if pattern.match(name)}


def _ros_table(path: Path, lines: list[tuple[int, str]], keys: dict[str, Any]) -> Table:
    sign = next((s for s in (",", ";", "\t") if s in lines[0][1]), ",")
    names = [cell.strip().strip('"') for cell in lines[0][1].split(sign)]
    known = _ros_names(lines[0][1])
    wanted = {ours: names.index(name) for name, ours in known.items()}
    roles = names.index("role") if "role" in names else None
    columns: dict[str, list[str]] = {name: [] for name in ("role", *wanted)}
    rows = []
    for k, line in lines[1:]:
        cells = [cell.strip().strip('"') for cell in line.split(sign)]
        if len(cells) != len(names):
            raise FileFormatError(
                f"{len(cells)} cells", file=path, row=k, expected=f"{len(names)} as in the header row"
            )
        columns["role"].append("touch" if roles is None else cells[roles])
        for name, at in wanted.items():
            columns[name].append(cells[at])
        rows.append(k)
    if not rows:
        raise FileFormatError("no data rows", file=path, expected="at least one row below the header")
    frame, lines_at = pl.DataFrame(columns), np.array(rows)
    return Table(path, keys, tuple(columns), lambda: (frame, lines_at))


FORMAT = PoseLists()
