"""What tracker programs export: lines of a point's name and its coordinates, in whatever dialect.

Shared by the readers of single programs. A dialect is a delimiter (tab, semicolon, comma, spaces), a decimal sign
(a comma is one only where it does not part cells) and a unit, which must be said: in the column's name, in a line of
its own, or by whoever asks for the file.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from decimal import Decimal, InvalidOperation
from pathlib import Path

import numpy as np
import polars as pl

from app.errors import CellValueError, FileFormatError, MissingColumnError
from app.recordings.list_text import read_text
from app.recordings.options import ReadOptions
from app.recordings.table import Table
from app.units import MM_PER_INCH

KIND = "tracker_points"
UNITS = {
    "mm": "mm",
    "millimeter": "mm",
    "millimeters": "mm",
    "millimetre": "mm",
    "millimetres": "mm",
    "m": "m",
    "meter": "m",
    "meters": "m",
    "metre": "m",
    "metres": "m",
    "in": "in",
    "inch": "in",
    "inches": "in",
}
#: What a list may be in that the columns of a table may not: it is brought to millimetres.
_INCH = Decimal(str(MM_PER_INCH))
#: Columns that name a point, or what was held to it, the same in every row.
_REFLECTOR = frozenset({"target", "targetname"})
_UNIT_LINE = re.compile(r"\b(?:units?|einheit(?:en)?)\b[^A-Za-z]*([A-Za-z]+)", re.IGNORECASE)
_AXIS_UNIT = re.compile(r"\bX\s*[\[(]\s*([A-Za-z]+)\s*[\])]", re.IGNORECASE)
_IN_NAME = re.compile(r"[\[(]\s*([A-Za-z]+)\s*[\])]|[\s_]([A-Za-z]+)$")
_NUMBER = re.compile(r"[+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d+)?\Z")
_OWN = re.compile(r"(?:^|[,;\t])\s*(?:q[0-9]+(?:_|[,;\t]|$)|role\b|axis\b|t_s\b|[xyz]_m{1,2}\b)")
_BRACKETED = re.compile(r"[\[(][^\])]{0,40}[\])]")
_LONGEST_NAME = 200  # characters of a column's name that say something; a longer cell is no name


@dataclass(frozen=True)
class Line:
    """One line: its number in the file and its cells."""

    number: int
    cells: tuple[str, ...]


def unit_said(lines: Sequence[str]) -> str | None:
    """The unit a line such as `Units: mm` or `X (mm), Y (mm), Z (mm)` states, or None."""
    for line in lines:
        match = _UNIT_LINE.search(line) or _AXIS_UNIT.search(line)
        if match and match.group(1).lower() in UNITS:
            return UNITS[match.group(1).lower()]
    return None


def unit_of(name: str) -> str | None:
    """The unit in a column's name: `X [mm]`, `X(m)`, `x_mm`, `X mm`."""
    match = _IN_NAME.search(name.strip())
    return UNITS.get((match.group(1) or match.group(2)).lower()) if match else None


def bare(name: str) -> str:
    """A column's name without unit, case and ornaments: `X [mm]` -> `x`, `Point ID` -> `pointid`."""
    without = _BRACKETED.sub("", name[:_LONGEST_NAME])
    parts = [p for p in re.split(r"[\s_.\-:#/\"]+", without.lower()) if p and p not in UNITS]
    return "".join(
        p for p in parts if p not in ("actual", "act", "measured", "meas", "ist", "coordinate", "coord")
    )


def delimiter_of(lines: Sequence[str]) -> str | None:
    """Tab, semicolon or comma, whichever parts most lines; None for spaces."""
    for sign in ("\t", ";"):
        if sum(sign in line for line in lines) > len(lines) / 2:
            return sign
    if sum(line.count(",") >= 3 for line in lines) > len(lines) / 2:
        return ","
    return None


def split(line: str, delimiter: str | None) -> tuple[str, ...]:
    """Cells of a line, without quotes and blanks around them."""
    cells = line.split() if delimiter is None else line.split(delimiter)
    return tuple(cell.strip().strip('"').strip() for cell in cells)


def is_number(cell: str) -> bool:
    """True for a number with a point or a comma in it."""
    return bool(_NUMBER.match(cell))


def number(cell: str, *, path: Path, row: int, column: str) -> str:
    """A cell's number with a decimal point.

    Raises:
        CellValueError: no number.
    """
    if not is_number(cell):
        found = f"found {cell[:40]!r}" if cell else "the cell is empty"
        raise CellValueError(found, file=path, row=row, column=column, expected="a number")
    return cell.replace(",", ".")


def headed(path: Path, text: str, name_columns: frozenset[str], source: str) -> Table:
    """A list with a header row that names a point column and X, Y, Z, after any number of lines of preface.

    Raises:
        FileFormatError: no such header row. CellValueError, MissingColumnError: by place.
    """
    lines = text.splitlines()
    found = header_line(lines, name_columns)
    if found is None:
        raise FileFormatError("no header row", file=path, expected="a point's name, X, Y, Z")
    at, delimiter = found
    cells = split(lines[at], delimiter)
    names = [bare(cell) for cell in cells]
    name_at = next(k for k, name in enumerate(names) if name in name_columns)
    places = []
    for axis in "xyz":
        if axis not in names:
            raise MissingColumnError(
                "this column is missing", file=path, row=at + 1, column=axis.upper(), expected="X, Y and Z"
            )
        places.append(names.index(axis))
    units = {unit_of(cells[k]) for k in places}
    unit = units.pop() if len(units) == 1 else None
    rows = []
    for k, line in enumerate(lines[at + 1 :], at + 2):
        if not line.strip() or line.lstrip().startswith(("//", "#")):
            continue
        row = split(line, delimiter)
        if len(row) <= max(name_at, *places):
            raise FileFormatError(
                f"{len(row)} cells", file=path, row=k, expected=f"{len(cells)} as in the header row"
            )
        xyz = tuple(number(row[p], path=path, row=k, column=cells[p]) for p in places)
        rows.append((k, row[name_at], xyz))
    if names[name_at] in _REFLECTOR and len(rows) > 1 and len(Counter(name for _, name, _ in rows)) == 1:
        rows = [
            (k, str(number), xyz) for number, (k, _, xyz) in enumerate(rows, 1)
        ]  # one reflector, no names
    return point_table(path, rows, unit or unit_said(lines[: at + 1]), source, at + 1)


def own_header(line: str) -> bool:
    """True for a header row of this program's own files, which are read as such even where a unit is missing."""
    return bool(_OWN.search(line))


def has_letters(line: str, letters: str) -> bool:
    """True where all these (small) letters are in a line, small or large: most are numbers, and name no column."""
    small = line.lower()
    return all(letter in small for letter in letters)


def header_line(lines: Sequence[str], name_columns: frozenset[str]) -> tuple[int, str | None] | None:
    """Index and delimiter of the first line that names a point column and at least X and Y."""
    for k, line in enumerate(lines[:100]):
        if not has_letters(line, "xy"):
            continue
        for sign in ("\t", ";", ",", None):
            names = {bare(cell) for cell in split(line, sign)}
            if {"x", "y"} <= names and names & name_columns:
                return k, sign
    return None


def point_table(
    path: Path,
    rows: Sequence[tuple[int, str, tuple[str, ...]]],
    unit: str | None,
    source: str,
    header_row: int,
) -> Table:
    """A Table of kind `tracker_points` with the columns name, x, y, z; without a unit its columns cannot be read.

    Raises:
        FileFormatError: no rows.
    """
    if not rows:
        raise FileFormatError("no data rows", file=path, row=header_row, expected="at least one point")
    if unit == "in":
        rows, unit = [(k, name, tuple(_in_mm(v) for v in xyz)) for k, name, xyz in rows], "mm"
    suffix = f"_{unit}" if unit else ""
    names = ("name", f"x{suffix}", f"y{suffix}", f"z{suffix}")
    frame = pl.DataFrame(
        [[name for _, name, _ in rows], *([xyz[k] for _, _, xyz in rows] for k in range(3))],
        schema=dict.fromkeys(names, pl.String),
    )
    lines = np.array([k for k, _, _ in rows], int)
    return Table(
        path, {"kind": KIND, "source": source, "__header_row__": header_row}, names, lambda: (frame, lines)
    )


def with_unit(table: Table, unit: str) -> Table:
    """The same list, its coordinates read in `unit` (`mm`, `m` or `in`) where the file itself does not say."""
    if table.kind != KIND or "x" not in table.names:
        return table
    frame, lines = table.load()
    suffix = "mm" if unit == "in" else unit
    names = ("name", *(f"{axis}_{suffix}" for axis in "xyz"))
    renamed = frame.rename(dict(zip(table.names, names, strict=True)))
    if unit == "in":
        renamed = renamed.with_columns(
            pl.Series(name, [_in_mm(v) for v in renamed[name].to_list()]) for name in names[1:]
        )
    return replace(table, names=names, load=lambda: (renamed, lines))


def _in_mm(inches: str) -> str:
    """A number in inches as millimetres, exactly."""
    try:
        return str(Decimal(inches) * _INCH)
    except InvalidOperation:
        return inches


def as_asked(table: Table, options: ReadOptions | None) -> Table:
    """A list in the unit that was said for it."""
    return table if options is None or options.unit is None else with_unit(table, options.unit)


@dataclass(frozen=True)
class HeadedList:
    """A format whose header row names its columns: makers differ only in what they call a point's name.

    Args:
        key: the format's name in the catalogue.
        title: what it says on a screen.
        names: what the column of a point's name may be called, small letters and digits only.
    """

    key: str
    title: str
    names: frozenset[str]

    def matches(self, path: Path, head: bytes) -> bool:
        """A header row with a point's name beside X and Y."""
        if not path.is_file() or b"\x00" in head or head.lstrip().startswith((b"#", b"//")):
            return False
        lines = head.decode("utf-8-sig", errors="replace").splitlines()
        found = header_line(lines, self.names)
        return found is not None and not own_header(lines[found[0]])

    def read(self, path: Path, options: ReadOptions | None = None) -> Table:
        """Reads all of it.

        Raises:
            FileFormatError, MissingColumnError, CellValueError: by row and column.
        """
        return as_asked(headed(path, read_text(path), self.names, self.title), options)
