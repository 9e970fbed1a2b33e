"""Teachframe's own CSV: `# key: value` lines, one header row, data rows; comma, UTF-8."""

from __future__ import annotations

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
        names = tuple(cell.strip().strip('"') for cell in text.split(","))
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
    with path.open("rb") as file:
        file.seek(offset)
        data = file.read()
    if b"\x00" in data:
        row = header_row + 1 + data[: data.index(b"\x00")].count(b"\n")
        raise FileFormatError("binary content", file=path, row=row, expected="text")
    lines = data.count(b"\n") + (0 if data.endswith(b"\n") or not data else 1)
    rows = np.arange(header_row + 1, header_row + 1 + lines)
    simple = b'"' not in data and b"\r" not in data
    if not simple or b"\n\n" in data or data.startswith(b"\n") or b"\n#" in data or data.startswith(b"#"):
        data, rows = _tidy(data, path, header_row)
    _check_width(data, rows, len(names), path)
    schema = dict.fromkeys(names, pl.String)
    try:
        frame = pl.read_csv(
            io.BytesIO(data), has_header=False, schema=schema, null_values="", truncate_ragged_lines=False
        )
    except pl.exceptions.PolarsError as error:
        _decode(data, path, header_row + 1)
        reason = str(error).splitlines()[0]
        raise FileFormatError(
            f"cannot read the rows ({reason})", file=path, row=header_row + 1, expected="comma-separated rows"
        ) from None
    frame = frame.with_columns(pl.all().str.strip_chars().replace("", None))
    return frame, rows[: len(frame)]


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
    """Every row has as many cells as the header: found by counting commas, located only when they do not fit."""
    if not len(rows):
        raise FileFormatError("no data rows", file=path, expected="at least one row below the header")
    if data.count(b",") == (width - 1) * len(rows) and b'"' not in data:
        uniform = True
    else:
        uniform = False
    if uniform and len(rows) > 20000:  # a sum that fits and a probe of the ends is enough for long logs
        probe = data[:20000].split(b"\n")[:-1] + data[-20000:].split(b"\n")[1:-1]
        if all(line.count(b",") == width - 1 for line in probe):
            return
    for line, row in zip(data.split(b"\n"), rows, strict=False):
        cells = line.count(b",") + 1
        if b'"' not in line and cells != width:
            raise FileFormatError(
                f"{cells} cells", file=path, row=int(row), expected=f"{width} as in the header row"
            )


FORMAT = Csv()
