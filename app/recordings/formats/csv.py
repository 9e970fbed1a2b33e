"""Teachframe's own CSV: `# key: value` lines, one header row, data rows; as written, or as a spreadsheet saved it."""

from __future__ import annotations

from pathlib import Path

from app.errors import FileFormatError
from app.recordings.columns import parse_column
from app.recordings.delimited.body import Body
from app.recordings.delimited.dialect import cells_of, dialect_of
from app.recordings.delimited.header import read_header
from app.recordings.delimited.source import Source, open_source
from app.recordings.options import ReadOptions, parse_mapping
from app.recordings.renaming import renamed_columns
from app.recordings.table import Once, Table

_HEAD_BYTES = 65536
_SAMPLE = 65536  # bytes of rows by which the decimal sign is told
_UNNAMED = "__unnamed_{}"


class Csv:
    key = "csv"
    title = "CSV with units in the column names; commas, semicolons or tabs, decimal commas, UTF-8 or UTF-16"
    fallback = True  # takes any text, so every other format is asked first

    def matches(self, path: Path, head: bytes) -> bool:
        return path.is_file() and (b"\x00" not in head or head.startswith((b"\xff\xfe", b"\xfe\xff")))

    def read(self, path: Path, options: ReadOptions | None = None) -> Table:
        """Reads the header only; the body follows when a column is asked for.

        Raises:
            FileFormatError: no text, no header row, or a key that cannot be read.
        """
        with path.open("rb") as file:
            source = open_source(path, file.read(_HEAD_BYTES))
        return read_own(source, options)


def read_own(source: Source, options: ReadOptions | None = None) -> Table:
    """The table in a text of this program's own form, or of one whose columns a mapping names.

    Raises:
        FileFormatError: no header row, or one that names nothing or something twice.
        InputError: a mapping that does not fit.
    """
    options = options or ReadOptions()
    path, header = source.path, read_header(source)
    first = next(source.chunks(header.offset, _SAMPLE), b"").decode("utf-8", errors="replace")
    dialect = dialect_of(header.text, first)
    cells = [cell.strip() for cell in cells_of(header.text, dialect, path, header.row)]
    named = len(cells)
    while named and not cells[named - 1]:  # a spreadsheet fills rows up
        named -= 1
    names = tuple(cells[:named])
    if not named or any(not name for name in names):
        place = next((i for i, name in enumerate(names) if not name), 0)
        raise FileFormatError(
            "a column without a name", file=path, row=header.row, column=str(place + 1), expected="a name"
        )
    if len(set(names)) != len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise FileFormatError(
            "this name stands there twice", file=path, row=header.row, column=twice, expected="one each"
        )
    mapping = {**parse_mapping(str(header.keys.get("map") or "")), **options.mapping}
    if mapping:
        names = renamed_columns(names, mapping, options, path)
        quantities = {parse_column(name).quantity for name in names}
        header.keys.setdefault("kind", "tracker" if {"x", "y", "z"} <= quantities else "motion")
    filled = (*names, *(_UNNAMED.format(k) for k in range(named, len(cells))))
    body = Body(source, header.offset, header.row, filled, dialect)
    header.keys["__header_row__"] = header.row
    return Table(path, header.keys, names, Once(body.load), written=body.text)


FORMAT = Csv()
