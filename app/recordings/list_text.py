"""The text of a list of points, as Windows programs write it too; what cannot be one is refused before it is parted."""

from __future__ import annotations

import re
from pathlib import Path

from app.errors import FileFormatError
from app.recordings.delimited.rows import MOST_EMPTY, mostly_empty

_LONGEST = 50_000_000  # bytes: a point list is not longer
_LINE = re.compile(rb"[^\r\n]*(?:\r\n|\r|\n)")
_ROW = re.compile(rb"[^\w#/\x80-\xff]*[\w\x80-\xff]")  # something is said that is no remark


def read_text(path: Path) -> str:
    """The file as text: UTF-8, or the code page Windows programs write.

    Raises:
        FileFormatError: binary, or too long for a list of points, or nearly all of it empty lines and remarks.
    """
    if path.stat().st_size > _LONGEST:
        raise FileFormatError("too long for a list of points", file=path, expected="a point export")
    data = path.read_bytes()
    if b"\x00" in data:
        row = 1 + data[: data.index(b"\x00")].count(b"\n")
        raise FileFormatError("binary content", file=path, row=row, expected="text")
    if data.count(b"\n") + data.count(b"\r") > MOST_EMPTY:
        _check_says_something(data, path)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("cp1252", errors="replace")


def _check_says_something(data: bytes, path: Path) -> None:
    """Refuses, before anything is made of them, more lines without a row than there are rows."""
    empty = count = first = 0
    for number, line in enumerate(_LINE.finditer(data), 1):
        if _ROW.match(line[0]):
            count += 1
            if count > MOST_EMPTY:
                return
            continue
        first, empty = first or number, empty + 1
        if empty > MOST_EMPTY and empty > count:
            raise mostly_empty(path, first)
