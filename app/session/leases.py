"""Which process writes a session: one at a time, over any number of processes and machines.

A process that holds a session adds one to the session's number of beats every second. Nobody's clock is compared with
another's: who wants the session takes it when the beats stand still as he watches, at once where the holder was a
process of this machine and is no more. A holder that is alive and sees that it is wanted lets go. Whoever lost a
session notices at its next action: a row is only kept while its writer holds the session.
"""

from __future__ import annotations

import contextlib
import os
import secrets
import socket
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from sqlalchemy import Column, Connection, Integer, Row, String, Table, delete, insert, select, update

from app.errors import ConflictError, StorageError
from app.session.database import METADATA, Database

LEASES = Table(
    "leases",
    METADATA,
    Column("session", String(32), primary_key=True),
    Column("worker", String(160), nullable=False, index=True),
    Column("beat", Integer, nullable=False),
    Column("wanted", String(160), nullable=False),  # by which process; empty by none
)
BEAT = 1.0  # seconds between two beats
STILL = 3.0  # seconds without a beat after which nobody holds the session: less than a person waits
_PATIENCE = 8.0  # seconds a session is waited for whose holder is alive
_LOOK = 0.1  # seconds between two looks
_BOOT = Path("/proc/sys/kernel/random/boot_id")
_PROCESSES = Path("/proc/self/ns/pid")


class Leases:
    """What one process holds.

    Args:
        database: the store's.
    """

    def __init__(self, database: Database):
        self._database = database
        #: Host, process, when it began: what another process of this machine can look up; and nobody else's.
        self.me = f"{_host()} {os.getpid()} {_began(os.getpid())} {secrets.token_hex(8)}"

    def begin(self, connection: Connection, session: str) -> None:
        """A session that is made in this transaction is held."""
        connection.execute(insert(LEASES), {"session": session, "worker": self.me, "beat": 0, "wanted": ""})

    def take(self, session: str) -> None:
        """The session is written here from now on; waits while another process holds it.

        Raises:
            StorageError: another process goes on holding it, or the database does not answer.
        """
        end = time.monotonic() + _PATIENCE
        seen: tuple[str, int] | None = None
        since = time.monotonic()
        while True:
            with self._database.begin() as connection:
                row = connection.execute(select(LEASES).where(LEASES.c.session == session)).first()
            if row is not None and (row.worker, row.beat) != seen:
                seen, since = (row.worker, row.beat), time.monotonic()
            if row is not None and row.worker == self.me:
                return
            if row is None or time.monotonic() - since >= STILL or _is_gone(row.worker):
                if self._taken(session, row):
                    return
            elif row.wanted != self.me:
                self._say(session, row, wanted=self.me)
            if time.monotonic() > end:
                raise StorageError("this session is open elsewhere")
            time.sleep(_LOOK)

    def _taken(self, session: str, row: Row | None) -> bool:
        """True where nobody else took it since it was seen so; `row` None where nobody had it."""
        if row is not None:
            return self._say(session, row, worker=self.me, beat=0, wanted="")
        return self._kept(lambda connection: self.begin(connection, session))

    def _say(self, session: str, row: Row, **values: object) -> bool:
        """Changes the row of a session; False where it is not as it was seen."""
        seen = _held(session, row.worker) & (LEASES.c.beat == row.beat)
        changed = 0

        def job(connection: Connection) -> None:
            nonlocal changed
            changed = connection.execute(update(LEASES).where(seen).values(**values)).rowcount

        # After a process was killed all of its people come at once: who asks SQLite for its lock one by one is passed
        # by the others, and some did not get it in five seconds.
        return self._kept(job) and changed > 0

    def _kept(self, job: Callable[[Connection], object]) -> bool:
        """False where another process was there first."""
        try:
            self._database.write(job)
        except ConflictError:
            return False
        return True

    def process(self, session: str) -> int | None:
        """The other process of this machine that holds a session; None where none does.

        Raises:
            StorageError: the database does not answer.
        """
        with self._database.begin() as connection:
            worker = connection.execute(select(LEASES.c.worker).where(LEASES.c.session == session)).scalar()
        host, _, rest = str(worker or "").partition(" ")
        process = rest.partition(" ")[0]
        here = worker != self.me and host == _host() and process.isdigit()
        return int(process) if here else None

    def let(self, session: str) -> None:
        """The session is not held here any more. A database that does not answer is no error: the beats stand still."""
        with contextlib.suppress(StorageError):
            self._database.write(
                lambda connection: connection.execute(delete(LEASES).where(_held(session, self.me)))
            )

    def beat(self) -> tuple[set[str], set[str]]:
        """One beat for all sessions held; those held, and those of them that another process wants.

        Raises:
            StorageError: the database does not answer.
        """
        mine = LEASES.c.worker == self.me
        rows: Sequence[Row] = ()

        def beat(connection: Connection) -> None:
            nonlocal rows
            connection.execute(update(LEASES).where(mine).values(beat=LEASES.c.beat + 1))
            rows = connection.execute(select(LEASES.c.session, LEASES.c.wanted).where(mine)).all()

        self._database.write(beat)
        return {row.session for row in rows}, {row.session for row in rows if row.wanted}


def check_held(connection: Connection, session: str, worker: str) -> None:
    """Asked after a row was written and before it is kept: until then nobody else can take the session.

    Raises:
        ConflictError: another process has it.
    """
    holder = select(LEASES.c.worker).where(LEASES.c.session == session).with_for_update(read=True)
    if connection.execute(holder).scalar() != worker:
        raise ConflictError("this session is open elsewhere now")


def _held(session: str, worker: str):
    return (LEASES.c.session == session) & (LEASES.c.worker == worker)


def _host() -> str:
    """This machine since it was started; a container, which counts its processes itself, is one of its own."""
    try:
        boot, count = _BOOT.read_text(encoding="ascii").strip()[:13], str(_PROCESSES.readlink())
    except OSError:
        boot = count = ""
    return f"{socket.gethostname()[:60].replace(' ', '_')}/{boot}/{count}"


def _began(process: int) -> str:
    """When a process of this machine began, as its system counts; empty where it is not there or does not tell."""
    try:
        said = Path(f"/proc/{process}/stat").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""
    after = said.rpartition(")")[2].split()
    return "" if after[0] in "ZX" else after[19]  # state; field 22: start time


def _is_gone(worker: str) -> bool:
    """True where the holder was a process of this machine that has ended."""
    host, process, began = [*worker.split(" "), "", ""][:3]
    return host == _host() and bool(began) and process.isdigit() and _began(int(process)) != began
