"""`# key: value` lines: a scalar or a flat list, written as in YAML, without aliases, tags or nesting.

Everything is bounded before a value is made of it: a short text can stand for gigabytes.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from app.errors import FileFormatError
from app.recordings.delimited.source import Source

_KEY = re.compile(r"^#\s*([A-Za-z_][A-Za-z0-9_]*)\s*:\s?(.*)$")
_PADDING = re.compile(r"[,;\t]+\Z")
_QUOTED = re.compile(r'^"(#(?:[^"]|"")*)"')
_HEAD_BYTES = 65536  # a header line that is longer is not one
_MOST_LINES = 10_000  # in front of the header row
_LONGEST = 10_000  # characters of a value
_LARGEST = 1e300
_EXPECTED = "a scalar or a flat list [a, b] as in YAML, without aliases, tags or nesting"


@dataclass(frozen=True, eq=False)
class Header:
    """What stands in front of the rows.

    Args:
        keys: `# key: value`.
        text: the header row.
        row: its line number.
        offset: bytes in front of the first data row.
    """

    keys: dict[str, Any]
    text: str
    row: int
    offset: int


def read_header(source: Source) -> Header:
    """Reads up to the header row.

    Raises:
        FileFormatError: not UTF-8, no header row, or a key that cannot be read.
    """
    path, keys = source.path, dict[str, Any]()
    number, offset, rest = 0, 0, b""
    pieces = source.chunks(0, _HEAD_BYTES)
    while True:
        end = rest.find(b"\n")
        while end < 0 and len(rest) < _HEAD_BYTES and (more := next(pieces, b"")):
            rest += more
            end = rest.find(b"\n")
        number += 1
        if not rest:
            raise FileFormatError("no header row", file=path, row=number, expected="column names")
        if (end < 0 and len(rest) >= _HEAD_BYTES) or end >= _HEAD_BYTES:
            raise FileFormatError(
                "a line without end", file=path, row=number, expected="column names, comma separated"
            )
        if number > _MOST_LINES:
            raise FileFormatError(
                f"over {_MOST_LINES} lines without a header row",
                file=path,
                row=number,
                expected="column names",
            )
        line, rest = (rest, b"") if end < 0 else (rest[: end + 1], rest[end + 1 :])
        offset += len(line)
        text = unpadded(_decode(line, path, number).lstrip("\ufeff").strip("\r\n"))
        if not text.strip():
            continue
        if not text.lstrip().startswith("#"):
            return Header(keys, text, number, offset)
        add_key(text.strip(), keys, path, number)


def unpadded(line: str) -> str:
    """A `#` line as it was before a spreadsheet quoted it and filled it up with empty cells; others as they are."""
    quoted = _QUOTED.match(line.lstrip())
    if quoted:
        return quoted.group(1).replace('""', '"')
    return _PADDING.sub("", line) if line.lstrip().startswith("#") else line


def _decode(data: bytes, path: Path, row: int) -> str:
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        raise FileFormatError("not UTF-8 text", file=path, row=row, expected="UTF-8") from None


def add_key(text: str, keys: dict[str, Any], path: Path, row: int) -> None:
    """Puts one `# key: value` line into `keys`; a line without a key is a comment.

    Raises:
        FileFormatError: the value is none of the kinds that are allowed.
    """
    match = _KEY.match(text)
    if match:
        keys[match.group(1)] = value_of(match.group(2).strip(), path, row, match.group(1))


def value_of(text: str, path: Path, row: int, key: str) -> Any:
    """A scalar, a flat list, or None; a value with a colon in it is plain text.

    Raises:
        FileFormatError: aliases, tags, nesting, or what is no YAML.
    """
    if not text:
        return None
    if len(text) > _LONGEST:
        raise _refused(f"a value of {len(text)} characters", path, row, key)
    try:
        plain = _is_plain(text, path, row, key)
        value = text if plain else yaml.safe_load(text)
    except (yaml.YAMLError, ValueError, RecursionError):
        raise _refused(f"cannot read {text[:40]!r}", path, row, key) from None
    for part in value if isinstance(value, list) else [value]:
        if isinstance(part, str) and any("\ud800" <= letter <= "\udfff" for letter in part):
            raise _refused("half a letter (a surrogate)", path, row, key)
        if isinstance(part, int | float) and _LARGEST < abs(part) < math.inf:
            raise _refused(f"cannot read {text[:40]!r}", path, row, key)
    return value


def _is_plain(text: str, path: Path, row: int, key: str) -> bool:
    """True where the text holds a colon that YAML would take for another key."""
    depth = 0
    for event in yaml.parse(text, Loader=yaml.SafeLoader):
        if isinstance(event, yaml.events.AliasEvent) or getattr(event, "anchor", None):
            raise _refused("an alias", path, row, key)
        if getattr(event, "tag", None):
            raise _refused("a tag", path, row, key)
        if isinstance(event, yaml.events.MappingStartEvent):
            if depth or text.startswith("{"):
                raise _refused("a table", path, row, key)
            return True
        if isinstance(event, yaml.events.SequenceStartEvent):
            depth += 1
            if depth > 1:
                raise _refused("a list within a list", path, row, key)
        if isinstance(event, yaml.events.SequenceEndEvent):
            depth -= 1
    return False


def _refused(what: str, path: Path, row: int, key: str) -> FileFormatError:
    return FileFormatError(what, file=path, row=row, column=key, expected=_EXPECTED)
