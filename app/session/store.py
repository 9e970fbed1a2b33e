"""The folder of all sessions: one journal each, under a name nobody guesses."""

from __future__ import annotations

import re
import secrets
from dataclasses import dataclass
from pathlib import Path

import platformdirs

from app.errors import InputError, TeachframeError, UnknownNameError
from app.session.journal import Journal, read_journal
from app.session.session import Session

JOURNAL = "journal.jsonl"
_NAME = re.compile(r"[0-9a-f]{32}\Z")


@dataclass(frozen=True)
class Listed:
    """A session in the store: its name, when it began (seconds since 1970), how many actions it holds."""

    name: str
    created: float
    actions: int


def default_folder() -> Path:
    """Where sessions are kept when nobody says otherwise."""
    return Path(platformdirs.user_data_dir("teachframe", appauthor=False))


class Store:
    """Sessions under DATA/sessions/NAME/journal.jsonl.

    Args:
        folder: the data folder; None takes the user's own.

    Raises:
        InputError: the folder cannot be written.
    """

    def __init__(self, folder: Path | None = None):
        self.folder = (folder or default_folder()) / "sessions"
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise InputError(f"cannot be written ({error.strerror})", file=self.folder) from None

    def create(self, *, robot: str | None = None) -> Session:
        """A new, empty session."""
        name = secrets.token_hex(16)
        return Session(Journal(self.path(name), name), robot=robot)

    def open(self, name: str) -> Session:
        """A session that was there before, as it was left.

        Raises:
            UnknownNameError: there is none of this name.
            FileFormatError: its journal is damaged in its middle.
        """
        if not self.has(name):
            raise UnknownNameError(name, available=[s.name for s in self.list()], what="session")
        return Session(Journal(self.path(name), name))

    def has(self, name: str) -> bool:
        """True where this session is kept here; any text may be asked about."""
        return bool(_NAME.match(name)) and self.path(name).is_file()

    def path(self, name: str) -> Path:
        """The journal of a session."""
        return self.folder / name / JOURNAL

    def list(self) -> list[Listed]:
        """All readable sessions, the newest first."""
        found = []
        for path in self.folder.glob(f"*/{JOURNAL}"):
            try:
                recorded = read_journal(path)
            except TeachframeError:
                continue
            found.append(Listed(path.parent.name, recorded.header.created, len(recorded.entries)))
        return sorted(found, key=lambda listed: -listed.created)


def find_journal(text: str, folder: Path | None = None) -> Path:
    """The journal meant by a path, a session's folder, or its name (or the beginning of it) in the data folder.

    Raises:
        UnknownNameError: none of these; lists the sessions there are.
    """
    path = Path(text)
    if path.is_dir() and (path / JOURNAL).is_file():
        return path / JOURNAL
    if path.is_file():
        return path
    root = (folder or default_folder()) / "sessions"
    names = [p.parent.name for p in sorted(root.glob(f"*/{JOURNAL}"))]
    matching = [name for name in names if name.startswith(text)] if text else []
    if len(matching) == 1:
        return root / matching[0] / JOURNAL
    raise UnknownNameError(text, available=names[:12] or ["(no sessions)"], what="session")
