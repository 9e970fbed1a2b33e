"""All sessions, in the database: one name nobody guesses each, one row an action."""

from __future__ import annotations

import re
import secrets
import time
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

import msgspec
import platformdirs
from sqlalchemy import Connection, delete, func, insert, select

from app.errors import FileFormatError, InputError, StorageError, TeachframeError, UnknownNameError
from app.session.actions import AnyAction
from app.session.arms import Arms
from app.session.database import ACTIONS, FILE, SESSIONS, Database, sqlite_url
from app.session.journal import MOST_ACTIONS, Entry, Header, Recorded, decoded, encode_journal, read_journal
from app.session.leases import LEASES, Leases, check_held
from app.session.session import Session, replay
from app.session.sqlite_file import close_folder
from app.session.state import SessionState

JOURNAL = "journal.jsonl"
_NAME = re.compile(r"[0-9a-f]{32}\Z")
_ROBOT = '{"do":"choose_robot"%'


@dataclass(frozen=True)
class Listed:
    """A session in the store.

    Args:
        name: its name.
        created, last: when it began and when the last action was done (seconds since 1970).
        actions: how many it holds.
        robot: its arm.
    """

    name: str
    created: float
    last: float
    actions: int
    robot: str = ""


def default_folder() -> Path:
    """Where sessions are kept when nobody says otherwise."""
    return Path(platformdirs.user_data_dir("teachframe", appauthor=False))


class Store:
    """Every session there is.

    Args:
        folder: the data folder; None takes the user's own. Journals of earlier versions found below it
            (sessions/NAME/journal.jsonl) are taken over once and left where they are.
        database: URL of a database; None keeps a SQLite file in the data folder.

    Raises:
        InputError: folder or database cannot be used.
    """

    def __init__(self, folder: Path | None = None, database: str | None = None):
        self.folder = folder or default_folder()
        if (self.folder / FILE).is_file():
            close_folder(self.folder)
        self.database = Database(database or sqlite_url(self.folder / FILE))
        for path in sorted((self.folder / "sessions").glob(f"*/{JOURNAL}")):
            if _NAME.match(path.parent.name) and not self.has(path.parent.name):
                try:
                    self.take(read_journal(path), path.parent.name)
                except TeachframeError:  # damaged: it stays where it is
                    continue

    def create(self, *, robot: str | None = None, leases: Leases | None = None) -> Session:
        """A new, empty session; held where there are leases."""
        header = Header(secrets.token_hex(16), time.time())

        def made(connection: Connection) -> None:
            connection.execute(insert(SESSIONS), {"name": header.session, "created": header.created})
            if leases is not None:
                leases.begin(connection, header.session)

        self.database.write(made)
        return Session(_Journal(self.database, Recorded(header, ()), leases), robot=robot)

    def open(self, name: str, *, leases: Leases | None = None) -> Session:
        """A session that was there before, as it was left.

        Args:
            name: its name.
            leases: hold it: what it writes is kept only as long as they do.

        Raises:
            UnknownNameError: there is none of this name.
            FileFormatError: a row of it is damaged.
        """
        return Session(_Journal(self.database, self.recorded(name), leases))

    def has(self, name: str) -> bool:
        """True where this session is kept here; any text may be asked about."""
        if not _NAME.match(name):
            return False
        with self.database.begin() as connection:
            return (
                connection.execute(select(SESSIONS.c.name).where(SESSIONS.c.name == name)).first() is not None
            )

    def recorded(self, name: str) -> Recorded:
        """The journal of a session.

        Raises:
            UnknownNameError: there is none of this name.
            FileFormatError: a row of it is damaged.
        """
        with self.database.begin() as connection:
            head = connection.execute(select(SESSIONS).where(SESSIONS.c.name == name)).first()
            rows = connection.execute(
                select(ACTIONS.c.n, ACTIONS.c.t, ACTIONS.c.action)
                .where(ACTIONS.c.session == name)
                .order_by(ACTIONS.c.n)
            ).all()
        if head is None:
            raise UnknownNameError(name, available=self.names()[:12] or ["(no sessions)"], what="session")
        source = f"session {name}"
        entries = tuple(Entry(n, t, decoded(text, AnyAction, source, n)) for n, t, text in rows)
        for number, entry in enumerate(entries, 1):
            if entry.n != number:
                raise FileFormatError(f"action {number} is missing", file=source, row=number)
        return Recorded(Header(head.name, head.created), entries, source=source)

    def state(self, name: str) -> SessionState:
        """The state a session was left in, without opening it."""
        return replay(self.recorded(name))

    def find(self, text: str) -> Recorded:
        """The session meant by its name or the beginning of it.

        Raises:
            UnknownNameError: none, or more than one.
        """
        names = self.names()
        matching = [name for name in names if name.startswith(text)] if text else []
        if len(matching) != 1:
            raise UnknownNameError(text, available=names[:12] or ["(no sessions)"], what="session")
        return self.recorded(matching[0])

    def export(self, name: str) -> bytes:
        """A session as the content of a JSONL file that `teachframe replay` reads."""
        recorded = self.recorded(name)
        return encode_journal(recorded.header, recorded.entries)

    def take(self, recorded: Recorded, name: str | None = None) -> str:
        """Takes a journal in from a file, under a new name unless one is given; the name."""
        name = name or secrets.token_hex(16)
        rows = [_row(name, entry) for entry in recorded.entries]
        with self.database.begin() as connection:
            connection.execute(insert(SESSIONS), {"name": name, "created": recorded.header.created})
            if rows:
                connection.execute(insert(ACTIONS), rows)
        return name

    def delete(self, name: str) -> None:
        """Takes a session away for good; one that is not there is no error."""
        with self.database.begin() as connection:
            connection.execute(delete(ACTIONS).where(ACTIONS.c.session == name))
            connection.execute(delete(LEASES).where(LEASES.c.session == name))
            connection.execute(delete(SESSIONS).where(SESSIONS.c.name == name))

    def names(self) -> list[str]:
        """Names of all sessions, the newest first."""
        with self.database.begin() as connection:
            return list(connection.scalars(select(SESSIONS.c.name).order_by(SESSIONS.c.created.desc())))

    def list(self, most: int | None = None, only: Collection[str] | None = None) -> list[Listed]:
        """Sessions, the newest first; of these names only, where some are given."""
        newest = select(SESSIONS.c.name).order_by(SESSIONS.c.created.desc(), SESSIONS.c.name).limit(most)
        if only is not None:
            newest = newest.where(SESSIONS.c.name.in_(only))
        # Which they are first: to count the actions of a whole class for the few that one person has took longer than
        # all else of opening a session.
        counted = (
            select(SESSIONS.c.name, SESSIONS.c.created, func.max(ACTIONS.c.t), func.count(ACTIONS.c.n))
            .outerjoin(ACTIONS, ACTIONS.c.session == SESSIONS.c.name)
            .where(SESSIONS.c.name.in_(newest.scalar_subquery()))
            .group_by(SESSIONS.c.name, SESSIONS.c.created)
            .order_by(SESSIONS.c.created.desc(), SESSIONS.c.name)
        )
        arms = (
            select(ACTIONS.c.session, ACTIONS.c.action)
            .where(ACTIONS.c.action.like(_ROBOT))
            .order_by(ACTIONS.c.n)
        )
        with self.database.begin() as connection:
            rows = connection.execute(counted).all()
            chosen = connection.execute(arms.where(ACTIONS.c.session.in_([row[0] for row in rows]))).all()
        robots = {session: msgspec.json.decode(text).get("robot", "") for session, text in chosen}
        return [
            Listed(name, created, last or created, count, robots.get(name, ""))
            for name, created, last, count in rows
        ]


class _Journal:
    """One session's rows, open for writing."""

    def __init__(self, database: Database, recorded: Recorded, leases: Leases | None = None):
        self._database, self.recorded, self._leases = database, recorded, leases
        self._count = len(recorded.entries)
        self._doubtful: dict[str, object] | None = None
        self._closed = False

    def append(self, action: AnyAction) -> Entry:
        """A row, on the disk when this returns. A number is given once: two writers cannot both have it.

        A row the database did not confirm may be there all the same, where its answer was lost on the way. Nobody has
        seen it count, so it makes room for the next one.
        """
        if self._closed:
            raise ValueError("this session is closed")
        if self._count >= MOST_ACTIONS:
            raise StorageError(f"this session is full ({MOST_ACTIONS} actions); begin another one")
        entry = Entry(self._count + 1, round(time.time(), 3), action)
        row, doubtful = _row(self.recorded.header.session, entry), self._doubtful

        def kept(connection: Connection) -> None:
            if doubtful is not None:
                same = [column == doubtful[column.name] for column in ACTIONS.columns]
                connection.execute(delete(ACTIONS).where(*same))
            connection.execute(insert(ACTIONS), row)
            if self._leases is not None:
                check_held(connection, self.recorded.header.session, self._leases.me)

        try:
            self._database.write(kept)
        except StorageError:
            self._doubtful = row
            raise
        self._count, self._doubtful = self._count + 1, None
        return entry

    def close(self) -> None:
        """No more actions."""
        self._closed = True


def _row(session: str, entry: Entry) -> dict[str, object]:
    text = msgspec.json.encode(entry.action).decode()
    return {"session": session, "n": entry.n, "t": entry.t, "action": text}


def find_recorded(text: str, folder: Path | None = None, database: str | None = None) -> Recorded:
    """The session meant by a file, a folder that holds one, or its name (or the beginning of it) in the store.

    Raises:
        UnknownNameError: none of these; lists the sessions there are.
        FileFormatError: a file that is no journal.
    """
    path = Path(text)
    if path.is_dir() and (path / JOURNAL).is_file():
        return read_journal(path / JOURNAL)
    if path.is_file():
        return read_journal(path)
    root = folder or default_folder()
    if database is None and not root.exists():
        raise UnknownNameError(text, available=["(no sessions)"], what="session")
    if database is None and not root.is_dir():
        raise InputError("not a folder", file=root, expected="the data folder of the pendant")
    store = Store(folder, database)
    Arms(store.database).grant()
    return store.find(text)
