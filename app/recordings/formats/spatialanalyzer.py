"""SpatialAnalyzer's ASCII points: `Collection Group Target X Y Z`, spaces or commas, `//` before comments.

Also `Collection::Group::Target, X, Y, Z`, and the shorter forms without collection or group. Further columns
(uncertainties, times) are left alone. A comment that names the unit (`// Units: millimeters`) is understood.

Source: New River Kinematics, SpatialAnalyzer User Manual, "Exporting ASCII Formatted Points".
"""

from __future__ import annotations

from pathlib import Path

from app.errors import FileFormatError
from app.recordings.list_text import read_text
from app.recordings.options import ReadOptions
from app.recordings.point_lists import (
    as_asked,
    delimiter_of,
    is_number,
    number,
    point_table,
    split,
    unit_said,
)
from app.recordings.table import Table


class SpatialAnalyzer:
    key = "spatialanalyzer"
    title = "SpatialAnalyzer ASCII points"

    def matches(self, path: Path, head: bytes) -> bool:
        """A first line that is a `//` comment, or a name with `::` before three numbers."""
        if not path.is_file() or b"\x00" in head:
            return False
        lines = [line for line in head.decode("utf-8-sig", errors="replace").splitlines() if line.strip()]
        if not lines or lines[0].lstrip().startswith("#"):
            return False
        return lines[0].lstrip().startswith("//") or "::" in lines[0]

    def read(self, path: Path, options: ReadOptions | None = None) -> Table:
        """Reads all of it.

        Raises:
            FileFormatError, CellValueError: by row.
        """
        lines = read_text(path).splitlines()
        comments = [line for line in lines if line.lstrip().startswith("//")]
        body = [
            (k, line)
            for k, line in enumerate(lines, 1)
            if line.strip() and not line.lstrip().startswith("//")
        ]
        delimiter = delimiter_of([line for _, line in body])
        rows = []
        for k, line in body:
            cells = split(line, delimiter)
            start = _coordinates(cells)
            if start is None:
                raise FileFormatError(
                    f"found {line.strip()[:40]!r}",
                    file=path,
                    row=k,
                    expected="a point's name and three coordinates",
                )
            name = "::".join(cell for cell in cells[:start] if cell)
            xyz = tuple(number(cell, path=path, row=k, column="XYZ") for cell in cells[start : start + 3])
            rows.append((k, name, xyz))
        table = point_table(path, rows, unit_said(comments), self.title, max(len(comments), 1))
        return as_asked(table, options)


def _coordinates(cells: tuple[str, ...]) -> int | None:
    """Where the three coordinates begin: after the words, and after a target that is a bare whole number."""
    start = (
        1 if "::" in cells[0] else next((k for k, cell in enumerate(cells) if is_number(cell)), len(cells))
    )
    if start < 3 and "::" not in cells[0] and len(cells) >= start + 4 and cells[start].isdigit():
        start += 1
    good = (
        start >= 1 and len(cells) >= start + 3 and all(is_number(cell) for cell in cells[start : start + 3])
    )
    return start if good else None


FORMAT = SpatialAnalyzer()
