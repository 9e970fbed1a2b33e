"""Teachframe's own CSV: `# key: value` lines, one header row, data rows; comma, UTF-8."""

from __future__ import annotations

import csv
import io
import re
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import yaml

from app.errors import FileFormatError
from app.recordings.table import Table

_HEAD_BYTES = 65536  # a header that is longer is not one
_CHUNK_BYTES = 1 << 24
_BLANK = re.compile(rb"(?:\A|\n)[ \t]*\n|\n[ \t]+\Z")  # an empty line, or one of spaces
_KEY = re.compile(r"^#\s*([A-Za-z_][A-Za-z0-9_]*)\s*:\s?(.*)$")


class Csv:
    key = "csv"
    title = "CSV with units in the column names"
    fallback = True  # takes any text, so every other format is asked first

    def matches(self, path: Path, head: bytes) -> bool:
        return path.is_file() and b"\x00" not in head

    def read(self, path: Path) -> Table:
        """Reads the header only; the body follows when a column is asked for.

        Raises:
            FileFormatError: not UTF-8, no header row, or a key that is no YAML.
        """
        keys: dict[str, Any] = {}
        with path.open("rb") as file:
            number = 0
            while True:
                line = file.readline(_HEAD_BYTES)
                number += 1
                if not line:
                    raise FileFormatError("no header row", file=path, row=number, expected="column names")
                if len(line) >= _HEAD_BYTES:
                    raise FileFormatError(
                        "a line without end", file=path, row=number, expected="column names, comma separated"
                    )
                text = _decode(line, path, number).lstrip("\ufeff").strip("\r\n")
                if not text.strip():
                    continue
                if not text.lstrip().startswith("#"):
                    break
                _key(text.strip(), keys, path, number)
            offset = file.tell()
        if "\r" in text:
            raise FileFormatError(
                "lines end in a carriage return alone",
                file=path,
                row=number,
                expected="LF or CR LF line ends",
            )
        names = tuple(cell.strip() for cell in _cells(text, path, number))
        if any(not name for name in names):
            place = next(i for i, name in enumerate(names) if not name)
            raise FileFormatError(
                "a column without a name", file=path, row=number, column=str(place + 1), expected="a name"
            )
        if len(set(names)) != len(names):
            twice = next(name for name in names if names.count(name) > 1)
            raise FileFormatError(
                "this name stands there twice", file=path, row=number, column=twice, expected="one each"
            )
        keys["__header_row__"] = number
        return Table(path, keys, names, lambda: _body(path, offset, number, names))


def _cells(line: str, path: Path, row: int) -> list[str]:
    """The cells of one line, quotes understood."""
    try:
        return next(csv.reader([line], skipinitialspace=True))
    except csv.Error as error:
        raise FileFormatError(
            f"cannot read the cells ({error})", file=path, row=row, expected="CSV"
        ) from None


def _decode(data: bytes, path: Path, row: int) -> str:
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        raise FileFormatError("not UTF-8 text", file=path, row=row, expected="UTF-8") from None


def _key(text: str, keys: dict[str, Any], path: Path, row: int) -> None:
    match = _KEY.match(text)
    if not match:
        return  # a plain comment
    try:
        value = yaml.safe_load(match.group(2)) if match.group(2).strip() else None
    except (yaml.YAMLError, ValueError, RecursionError):
        raise FileFormatError(
            f"cannot read {match.group(2)[:40]!r}", file=path, row=row, column=match.group(1), expected="YAML"
        ) from None
    keys[match.group(1)] = value


def _body(
    path: Path, offset: int, header_row: int, names: tuple[str, ...]
) -> tuple[pl.DataFrame, np.ndarray]:
    data = _read(path, offset, header_row)
    lines = data.count(b"\n") + (0 if data.endswith(b"\n") or not data else 1)
    rows = np.arange(header_row + 1, header_row + 1 + lines)
    plain = b'"' not in data and b"\r" not in data and b"#" not in data
    # As many commas as the rows need, and (the parser sees to it) none with more: then none has fewer either.
    full = plain and len(names) > 1 and data.count(b",") == lines * (len(names) - 1) > 0
    frame = _frame(data, names) if full else None
    if not isinstance(frame, pl.DataFrame) or len(frame) != lines:
        if not plain or _BLANK.search(data):
            data, rows = _tidy(data, path, header_row)
        _check_width(data, rows, len(names), path)
        frame = _frame(data, names)
    if isinstance(frame, str):
        raise FileFormatError(
            f"cannot read the rows ({frame})", file=path, row=header_row + 1, expected="comma-separated rows"
        )
    frame = frame.with_columns(pl.all().str.strip_chars().replace("", None))
    return frame, rows[: len(frame)]


def _frame(data: bytes, names: tuple[str, ...]) -> pl.DataFrame | str:
    """The cells as text, or why they cannot be read; a row with too many cells is refused, one with too few filled."""
    try:
        return pl.read_csv(
            io.BytesIO(data),
            has_header=False,
            schema=dict.fromkeys(names, pl.String),
            null_values="",
            truncate_ragged_lines=False,
        )
    except pl.exceptions.PolarsError as error:
        return str(error).splitlines()[0]


def _read(path: Path, offset: int, header_row: int) -> bytes:
    """Everything below the header as UTF-8 text; binary content stops it early, however long the file is."""
    chunks: list[bytes] = []
    with path.open("rb") as file:
        file.seek(offset)
        while chunk := file.read(_CHUNK_BYTES):
            if b"\x00" in chunk:
                before = b"".join(chunks) + chunk[: chunk.index(b"\x00")]
                row = header_row + 1 + before.count(b"\n")
                raise FileFormatError("binary content", file=path, row=row, expected="text")
            chunks.append(chunk)
    data = b"".join(chunks)
    if not data.isascii():
        try:
            data.decode("utf-8")
        except UnicodeDecodeError as error:
            row = header_row + 1 + data[: error.start].count(b"\n")
            raise FileFormatError("not UTF-8 text", file=path, row=row, expected="UTF-8") from None
    return data


def _tidy(data: bytes, path: Path, header_row: int) -> tuple[bytes, np.ndarray]:
    """Drops blank and comment lines while remembering which line each row stood on."""
    kept, rows = [], []
    for number, line in enumerate(
        data.replace(b"\r\n", b"\n").replace(b"\r", b"\n").split(b"\n"), header_row + 1
    ):
        if line.strip() and not line.lstrip().startswith(b"#"):
            if line.count(b'"') % 2:
                raise FileFormatError(
                    "a quote is not closed", file=path, row=number, expected="a closing quote"
                )
            kept.append(line)
            rows.append(number)
    return b"\n".join(kept) + (b"\n" if kept else b""), np.array(rows, int)


def _check_width(data: bytes, rows: np.ndarray, width: int, path: Path) -> None:
    """Every row has as many cells as the header.

    Commas are counted for all lines at once; only lines with quotes are taken apart one by one.
    """
    if not len(rows):
        raise FileFormatError("no data rows", file=path, expected="at least one row below the header")
    bytes_ = np.frombuffer(data, np.uint8)
    ends = np.flatnonzero(bytes_ == ord("\n"))
    if not data.endswith(b"\n"):
        ends = np.append(ends, len(data))
    cells = np.diff(np.searchsorted(np.flatnonzero(bytes_ == ord(",")), ends), prepend=0) + 1
    if b'"' in data:
        for k, line in enumerate(data.split(b"\n")[: len(rows)]):
            if b'"' in line:
                cells[k] = len(_cells(line.decode("utf-8"), path, int(rows[k])))
    wrong = np.flatnonzero(cells != width)
    if len(wrong):
        k = int(wrong[0])
        raise FileFormatError(
            f"{cells[k]} cells", file=path, row=int(rows[k]), expected=f"{width} as in the header row"
        )


FORMAT = Csv()
