"""The journal as a file: one JSON line an action. What is exported, replayed, and kept where nobody has a database.

The first line says what the file is. A copy cut short has at most one torn last line: reading passes over it and says
so.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import msgspec

from app.errors import FileFormatError
from app.session.actions import AnyAction

FORMAT = "teachframe.session/1"


class Header(msgspec.Struct, frozen=True):
    """First line of a journal; `created` is seconds since 1970."""

    session: str
    created: float
    format: str = FORMAT


class Entry(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One action: its number from 1, when it was done (seconds since 1970), and what it was."""

    n: int
    t: float
    action: AnyAction


@dataclass(frozen=True)
class Recorded:
    """A journal as read.

    Args:
        header: what it says of itself.
        entries: the actions in order.
        torn: True where a last line was not finished.
        source: where it was read from, for messages.
        first_row: row of the first action there, for messages.
    """

    header: Header
    entries: tuple[Entry, ...]
    torn: bool = False
    source: str | Path = ""
    first_row: int = 1


class Journal(Protocol):
    """What a session writes its actions to."""

    @property
    def recorded(self) -> Recorded:
        """What was there when it was opened."""
        ...

    def append(self, action: AnyAction) -> Entry:
        """Keeps one action: when this returns, nothing that happens to the process can lose it."""
        ...

    def close(self) -> None:
        """No more actions; closing twice is fine."""
        ...


def encode_journal(header: Header, entries: Iterable[Entry]) -> bytes:
    """The file's content."""
    lines = [msgspec.json.encode(header), *(msgspec.json.encode(entry) for entry in entries)]
    return b"\n".join(lines) + b"\n"


def read_journal(path: Path) -> Recorded:
    """Reads a journal; a torn last line is left out and reported in `torn`.

    Raises:
        FileFormatError: no such file, not a journal, or a whole line that is not an action.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise FileFormatError(f"cannot be read ({error.strerror})", file=path) from None
    whole, _, rest = data.rpartition(b"\n")
    lines = whole.split(b"\n") if whole else []
    if not lines:
        raise FileFormatError("not a session's journal", file=path, row=1, expected=FORMAT)
    header = decoded(lines[0], Header, path, 1)
    if header.format != FORMAT:
        raise FileFormatError(f"its format is {header.format!r}", file=path, row=1, expected=FORMAT)
    entries = []
    for row, line in enumerate(lines[1:], 2):
        entry = decoded(line, Entry, path, row)
        if entry.n != row - 1:
            raise FileFormatError(
                f"action number {entry.n}", file=path, row=row, column="n", expected=str(row - 1)
            )
        entries.append(entry)
    return Recorded(header, tuple(entries), bool(rest), path, 2)


def decoded(text: bytes | str, kind, source: str | Path, row: int):
    """A header, an entry or an action from its JSON; raises FileFormatError that names the row."""
    try:
        return msgspec.json.decode(text, type=kind)
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        expected = "a session's journal" if kind is Header else "one action as JSON"
        raise FileFormatError(f"not readable ({error})", file=source, row=row, expected=expected) from None
