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
from app.files import read_bytes
from app.session.actions import AnyAction
from app.typed import learnt

FORMAT = "teachframe.session/1"
#: A day of work is about a megabyte [bytes].
LARGEST_FILE = 50_000_000
MOST_ACTIONS = 200_000
#: The end of the year 9999 [s since 1970]: calendars end there.
LATEST = 253_402_300_799.0


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


#: What a line may be.
_DECODERS = {kind: learnt(kind) for kind in (Header, Entry, AnyAction)}


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
    data = read_bytes(path, LARGEST_FILE, "a session's journal")
    whole, _, rest = data.rpartition(b"\n")
    if whole.count(b"\n") > MOST_ACTIONS:
        raise FileFormatError("too many actions", file=path, expected=f"at most {MOST_ACTIONS}")
    lines = whole.split(b"\n") if whole else []
    if not lines:
        raise FileFormatError("not a session's journal", file=path, row=1, expected=FORMAT)
    header = decoded(lines[0], Header, path, 1)
    if header.format != FORMAT:
        raise FileFormatError(f"its format is {header.format[:40]!r}", file=path, row=1, expected=FORMAT)
    _check_time(header.created, path, 1, "created")
    entries = []
    for row, line in enumerate(lines[1:], 2):
        entry = decoded(line, Entry, path, row)
        if entry.n != row - 1:
            raise FileFormatError(
                f"action number {entry.n}", file=path, row=row, column="n", expected=str(row - 1)
            )
        _check_time(entry.t, path, row, "t")
        entries.append(entry)
    return Recorded(header, tuple(entries), bool(rest), path, 2)


def _check_time(seconds: float, path: Path, row: int, column: str) -> None:
    """Raises FileFormatError unless a calendar has this time."""
    if not 0.0 <= seconds <= LATEST:
        raise FileFormatError(
            f"found {seconds!r}", file=path, row=row, column=column, expected="seconds since 1970"
        )


def decoded(text: bytes | str, kind, source: str | Path, row: int):
    """A header, an entry or an action from its JSON; raises FileFormatError that names the row."""
    try:
        return _DECODERS[kind].decode(text)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        expected = "a session's journal" if kind is Header else "one action as JSON"
        raise FileFormatError(f"not readable ({error})", file=source, row=row, expected=expected) from None
