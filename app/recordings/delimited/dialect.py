"""How a table's cells are parted, and how its numbers are written: found by the header row and the first rows."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass
from pathlib import Path

from app.errors import FileFormatError
from app.recordings.columns import parse_column

DELIMITERS = (",", ";", "\t")
_COMMA_NUMBER = re.compile(r"[+-]?\d*,\d+(?:[eE][+-]?\d+)?\Z")


@dataclass(frozen=True)
class Dialect:
    """Delimiter, and whether the decimal sign is a comma (never where cells are parted by commas)."""

    delimiter: str
    decimal_comma: bool = False


def delimiter_of(header: str) -> str:
    """The sign that parts most names which are columns we know, else most names at all."""

    def told(sign: str) -> tuple[int, int]:
        names = [name.strip().strip('"') for name in header.split(sign)]
        known = sum(bool(c.known or c.missing_unit) for c in map(parse_column, names))
        return known, len(names)

    return max(DELIMITERS, key=told)


def dialect_of(header: str, first_rows: str) -> Dialect:
    """The dialect of a table whose header row and first rows are these."""
    sign = delimiter_of(header)
    if sign == ",":
        return Dialect(sign)
    cells = [cell.strip().strip('"') for line in first_rows.splitlines() for cell in line.split(sign)]
    commas = sum(bool(_COMMA_NUMBER.match(cell)) for cell in cells)
    points = sum("." in cell and cell.replace(".", "", 1).lstrip("+-").isdigit() for cell in cells)
    return Dialect(sign, commas > points)


def cells_of(line: str, dialect: Dialect, path: Path, row: int) -> list[str]:
    """The cells of one line, quotes understood.

    Raises:
        FileFormatError: a quote in the wrong place, or a cell without end.
    """
    try:
        return next(csv.reader([line], delimiter=dialect.delimiter, skipinitialspace=True))
    except csv.Error as error:
        raise FileFormatError(
            f"cannot read the cells ({error})", file=path, row=row, expected="CSV"
        ) from None
