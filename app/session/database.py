"""Where sessions and training records are kept: SQLite in the data folder, or any other database by its URL.

A row an action. SQLite writes ahead and waits for the disk at each commit (WAL, synchronous FULL), so a process killed
at any moment leaves whole actions only, and all those that were confirmed. PostgreSQL does the same by itself.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from sqlalchemy import Column, Connection, Float, Integer, MetaData, String, Table, Text, create_engine, event
from sqlalchemy.engine import URL, make_url
from sqlalchemy.exc import ArgumentError, IntegrityError, NoSuchModuleError, SQLAlchemyError

from app.errors import ConflictError, InputError, StorageError, one_line
from app.session import sqlite_file
from app.session.migrations import upgrade
from app.session.together import Together

FILE = "teachframe.sqlite"
#: Drivers for URLs that name only the kind of database.
_DRIVERS = {"postgresql": "postgresql+psycopg", "postgres": "postgresql+psycopg"}
_BUSY = 5.0  # seconds another program may hold the file or the table before an action fails: a person waits for it
_DEADLOCK = "40P01"  # what PostgreSQL says where two wait for each other: each may come through alone
_ANSWER = 10  # whole seconds a database server has to answer when it is first spoken to

#: All tables, those of layers above too; `migrations` makes them.
METADATA = MetaData()
SESSIONS = Table(
    "sessions",
    METADATA,
    Column("name", String(32), primary_key=True),
    Column("created", Float, nullable=False),
)
ACTIONS = Table(
    "actions",
    METADATA,
    Column("session", String(32), primary_key=True),
    Column("n", Integer, primary_key=True, autoincrement=False),
    Column("t", Float, nullable=False),
    Column("action", Text, nullable=False),
    sqlite_with_rowid=False,
)


class Database:
    """One database, from any thread.

    Args:
        url: as SQLAlchemy writes it, `sqlite:////path/file` or `postgresql://user@host/name`.

    Raises:
        InputError: not a URL, a driver that is not installed, a database that does not answer, or one that a later
            version made.
    """

    def __init__(self, url: str | URL):
        address = _address(url)
        self.name = address.render_as_string(hide_password=True)
        lite = address.get_backend_name() == "sqlite"
        post = address.get_backend_name() == "postgresql"
        if post and "connect_timeout" not in address.query:
            address = address.update_query_dict({"connect_timeout": str(_ANSWER)})
        options = {"connect_args": {"timeout": _BUSY}} if lite else {"pool_pre_ping": True}
        try:
            self._engine = create_engine(address, **options)
            self._together = Together(lambda: self.begin())
            if lite:
                sqlite_file.prepare(Path(str(address.database)))
                event.listen(self._engine, "connect", _durable)
            elif post:
                event.listen(self._engine, "connect", _patient)
            with self._engine.begin() as connection:
                upgrade(connection, self.name)
        except ModuleNotFoundError as error:
            raise InputError(
                f"{self.name} needs the package {error.name}",
                column="--database",
                expected="an installed driver",
            ) from None
        except (ArgumentError, NoSuchModuleError) as error:
            raise InputError(f"{self.name}: {_said(error)}", column="--database") from None
        except SQLAlchemyError as error:
            raise InputError(f"{self.name} cannot be used ({_said(error)})", column="--database") from None

    @property
    def file(self) -> Path | None:
        """The file, where the database is one."""
        url = self._engine.url
        return Path(str(url.database)) if url.get_backend_name() == "sqlite" else None

    @contextmanager
    def snapshot(self) -> Iterator[Connection]:
        """A transaction that sees one moment, however long it reads; raises StorageError."""
        with self.begin() as connection:
            if connection.dialect.name == "postgresql":
                connection.exec_driver_sql("SET TRANSACTION ISOLATION LEVEL REPEATABLE READ")
            yield connection

    @contextmanager
    def begin(self) -> Iterator[Connection]:
        """A transaction: all of it is kept when the block ends, or nothing.

        Raises:
            StorageError: the database did not take or give it.
        """
        try:
            with self._engine.begin() as connection:
                yield connection
        except IntegrityError:
            raise ConflictError("another program writes to the same session") from None
        except SQLAlchemyError as error:
            if getattr(getattr(error, "orig", None), "sqlstate", "") == _DEADLOCK:
                raise ConflictError("another program writes to the same sessions") from None
            raise StorageError(f"{self.name} did not keep this ({_said(error)})") from None

    def write(self, job: Callable[[Connection], object]) -> None:
        """Does `job` in a transaction, perhaps with others' jobs: a commit is shared by all who wait for one. It may be
        done twice: where another's fails, each is done alone.

        Raises:
            ConflictError: another program writes there; the others' jobs are kept.
            StorageError: the database did not take it.
        """
        self._together.write(job)

    def close(self) -> None:
        """Lets go of all connections."""
        self._engine.dispose()


def sqlite_url(path: Path) -> URL:
    """The URL of a file."""
    return URL.create("sqlite", database=str(path))


def _address(url: str | URL) -> URL:
    try:
        address = make_url(url)
    except ArgumentError:
        raise InputError(
            f"{str(url)!r} is no database",
            column="--database",
            expected="sqlite:///FILE or postgresql://USER@HOST/NAME",
        ) from None
    address = address.set(drivername=_DRIVERS.get(address.drivername, address.drivername))
    if address.get_backend_name() == "sqlite" and address.database in (None, "", ":memory:"):
        raise InputError("a database in memory keeps nothing", column="--database", expected="sqlite:///FILE")
    return address


def _durable(connection, _record) -> None:
    cursor = connection.cursor()
    for pragma in ("journal_mode=WAL", "synchronous=FULL"):
        cursor.execute(f"PRAGMA {pragma}")
    cursor.close()


def _patient(connection, _record) -> None:
    connection.autocommit = True  # else it would be undone with the first transaction
    connection.execute(f"SET lock_timeout = '{_BUSY:g}s'")
    connection.autocommit = False


def _said(error: SQLAlchemyError) -> str:
    """What the driver said, without SQLAlchemy's advice."""
    return one_line(str(getattr(error, "orig", None) or error).partition("\n")[0], 200)
