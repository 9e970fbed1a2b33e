"""The journal: one JSON line an action, on the disk before the action counts.

The first line says what the file is. A process killed while writing leaves at most one torn last line: reading
passes over it and says so, writing on cuts it off first.
"""

from __future__ import annotations

import os
import time
from dataclasses import dataclass
from pathlib import Path

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
        header: what the file says of itself.
        entries: the actions in order.
        length: bytes up to the end of the last whole line.
        torn: True where a line after that was not finished.
    """

    header: Header
    entries: tuple[Entry, ...]
    length: int
    torn: bool


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
    header = _decode(lines[0], Header, path, 1)
    if header.format != FORMAT:
        raise FileFormatError(f"its format is {header.format!r}", file=path, row=1, expected=FORMAT)
    entries = []
    for row, line in enumerate(lines[1:], 2):
        entry = _decode(line, Entry, path, row)
        if entry.n != row - 1:
            raise FileFormatError(
                f"action number {entry.n}", file=path, row=row, column="n", expected=str(row - 1)
            )
        entries.append(entry)
    return Recorded(header, tuple(entries), len(whole) + 1, bool(rest))


def _decode(line: bytes, kind: type, path: Path, row: int):
    try:
        return msgspec.json.decode(line, type=kind)
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        expected = "a session's journal" if kind is Header else "one action as JSON"
        raise FileFormatError(f"not readable ({error})", file=path, row=row, expected=expected) from None


class Journal:
    """A journal open for writing. Each line is on the disk when `append` returns.

    Args:
        path: the file; made, with its header, where it is not there yet.
        session: name of the session, for a new file.
    """

    def __init__(self, path: Path, session: str):
        self.path = path
        if _begun(path):
            recorded = read_journal(path)
            self.recorded = recorded
            self._file = path.open("r+b", buffering=0)
            self._file.truncate(recorded.length)
            self._file.seek(recorded.length)
        else:
            header = Header(session, time.time())
            self.recorded = Recorded(header, (), 0, False)
            path.parent.mkdir(parents=True, exist_ok=True)
            self._file = path.open("wb", buffering=0)
            self._write(msgspec.json.encode(header))
            _sync_folder(path.parent)
        self._count = len(self.recorded.entries)

    def append(self, action: AnyAction) -> Entry:
        """Writes one action and waits until the disk has it."""
        entry = Entry(self._count + 1, round(time.time(), 3), action)
        self._write(msgspec.json.encode(entry))
        self._count += 1
        return entry

    def close(self) -> None:
        """Closes the file; closing twice is fine."""
        self._file.close()

    def _write(self, line: bytes) -> None:
        start = self._file.tell()
        try:
            rest = memoryview(line + b"\n")
            while rest:
                rest = rest[self._file.write(rest) :]
            os.fsync(self._file.fileno())
        except (
            OSError
        ):  # a full disk: leave no half line behind, so that the next action can still be written
            self._file.seek(start)
            self._file.truncate(start)
            raise


def _begun(path: Path) -> bool:
    """True where the file has at least its first line: a process killed before that left nothing to lose."""
    if not path.exists():
        return False
    with path.open("rb") as file:
        return file.readline().endswith(b"\n")


def _sync_folder(folder: Path) -> None:
    """A new file's name is only safe once its folder is on the disk too."""
    if os.name != "posix":
        return
    handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
