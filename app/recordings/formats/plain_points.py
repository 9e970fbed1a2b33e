"""Point lists without names: a header row `X [mm]; Y [mm]; Z [mm]`, with whatever stands beside it.

The rows are numbered in their order. Which pose each belongs to is told by a list of joint angles (`--joints`).
"""

from __future__ import annotations

from pathlib import Path

from app.errors import FileFormatError
from app.recordings.list_text import read_text
from app.recordings.options import ReadOptions
from app.recordings.point_lists import (
    as_asked,
    bare,
    has_letters,
    number,
    own_header,
    point_table,
    split,
    unit_of,
    unit_said,
)
from app.recordings.table import Table

_SIGNS = ("\t", ";", ",", None)
_LOOKED_AT = 100  # lines in which the header row may stand


class PlainPoints:
    key = "plain_points"
    title = "Point lists without names"

    def matches(self, path: Path, head: bytes) -> bool:
        """A header row with X, Y and Z that is none of this program's own."""
        if not path.is_file() or b"\x00" in head or head.lstrip().startswith((b"#", b"//")):
            return False
        lines = head.decode("utf-8-sig", errors="replace").splitlines()
        found = _header(lines)
        return found is not None and not own_header(lines[found[0]])

    def read(self, path: Path, options: ReadOptions | None = None) -> Table:
        """Reads all of it.

        Raises:
            FileFormatError, CellValueError: by row and column.
        """
        lines = read_text(path).splitlines()
        found = _header(lines)
        if found is None:
            raise FileFormatError("no header row", file=path, expected="X, Y, Z")
        at, sign = found
        cells = split(lines[at], sign)
        names = [bare(cell) for cell in cells]
        places = [names.index(axis) for axis in "xyz"]
        units = {unit_of(cells[k]) for k in places}
        rows = []
        for k, line in enumerate(lines[at + 1 :], at + 2):
            if not line.strip() or line.lstrip().startswith(("//", "#")):
                continue
            row = split(line, sign)
            if len(row) <= max(places):
                raise FileFormatError(
                    f"{len(row)} cells", file=path, row=k, expected=f"{len(cells)} as in the header row"
                )
            xyz = tuple(number(row[p], path=path, row=k, column=cells[p]) for p in places)
            rows.append((k, str(len(rows) + 1), xyz))
        unit = units.pop() if len(units) == 1 else None
        table = point_table(path, rows, unit or unit_said(lines[: at + 1]), self.title, at + 1)
        return as_asked(table, options)


def _header(lines: list[str]) -> tuple[int, str | None] | None:
    """Index and delimiter of the first line that names X, Y and Z."""
    for k, line in enumerate(lines[:_LOOKED_AT]):
        if not has_letters(line, "xyz"):
            continue
        for sign in _SIGNS:
            cells = split(line, sign)
            if {"x", "y", "z"} <= {bare(cell) for cell in cells} and len(cells) < 1000:
                return k, sign
    return None


FORMAT = PlainPoints()
