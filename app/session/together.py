"""What several sessions of a process write at once goes to the disk at once.

Each commit waits for the disk, and SQLite lets one writer in at a time: of two hundred people who record and delete
each waited for all before him, and who looked for the lock too seldom did not get it in time. Whoever gets his turn
here writes for all who wait.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass, field

from sqlalchemy import Connection

from app.errors import ConflictError, StorageError


@dataclass(eq=False)
class _Write:
    job: Callable[[Connection], object]
    done: bool = False
    # Until it is known: whoever was to write it may have been ended in the midst of it.
    error: Exception | None = field(default_factory=lambda: StorageError("this was not kept"))


class Together:
    """Writes of one process.

    Args:
        begin: a transaction, kept when it ends.
    """

    def __init__(self, begin: Callable[[], AbstractContextManager[Connection]]):
        self._begin = begin
        self._lock, self._turn = threading.Lock(), threading.Lock()
        self._waiting: list[_Write] = []

    def write(self, job: Callable[[Connection], object]) -> None:
        """Does `job` in a transaction, perhaps with others' jobs; on the disk when this returns.

        Raises:
            Exception: what it raised, or the database; nothing of it is kept then.
        """
        mine = _Write(job)
        with self._lock:
            self._waiting.append(mine)
        with self._turn:
            if not mine.done:  # nobody has done it meanwhile
                with self._lock:
                    writes, self._waiting = self._waiting, []
                self._do(writes)
        if mine.error is not None:
            raise mine.error

    def _do(self, writes: list[_Write]) -> None:
        error = self._kept(writes)
        database = isinstance(error, StorageError) and not isinstance(error, ConflictError)
        if error is not None and not database and len(writes) > 1:  # one of them may not: the others may
            for write in writes:
                write.error = self._kept([write])
        else:
            for write in writes:
                write.error = error
        for write in writes:
            write.done = True

    def _kept(self, writes: list[_Write]) -> Exception | None:
        """All of them, or none and why."""
        try:
            with self._begin() as connection:
                for write in writes:
                    write.job(connection)
        except Exception as error:
            return error
        return None
