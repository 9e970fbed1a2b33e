"""A backup: all tables in one SQLite file, whatever the database, with what tells that it is whole.

SQLite's own online backup copies a file while the server writes to it; of another database all rows are read in one
transaction. Beside the tables stands a list of them, each with its rows' number and SHA-256. A backup is checked
against it when it has been written and before it is used; it moves between SQLite and PostgreSQL, and to later
versions.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import secrets
import shutil
import sqlite3
import tempfile
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from urllib.parse import quote

import msgspec
from sqlalchemy import (
    Column,
    Connection,
    Integer,
    MetaData,
    String,
    Table,
    func,
    insert,
    inspect,
    select,
    text,
)

from app import __version__
from app.errors import FileFormatError, InputError, one_line
from app.files import check_readable, check_writable
from app.session.database import Database, sqlite_url
from app.session.migrations import VERSION, make_anew
from app.session.sqlite_file import FILE_MODE

_CONTENT = Table(
    "backup_content",
    MetaData(),
    Column("name", String(64), primary_key=True),
    Column("rows", Integer, nullable=False),
    Column("sha256", String(64), nullable=False),
    Column("program", String(32), nullable=False),
)
#: Of the moment: who holds what, which step the tables are at.
_PASSING = frozenset({"leases", VERSION, _CONTENT.name})
#: Made by a server that only started: no work of anybody.
_EMPTY = frozenset({"keys", "tries"})
_AT_ONCE = 1000  # rows in memory
_PAGES = 1024  # of SQLite, between two of which a server may write


def back_up(database: Database, out: Path, *, replace: bool = False) -> dict[str, int]:
    """Writes a backup, whole or not at all.

    Args:
        database: what is backed up; it may be in use.
        out: the file.
        replace: True takes the place of a file that is there.

    Returns:
        Table -> rows.

    Raises:
        InputError: the file is there, or cannot be written.
        StorageError: the database does not give its rows.
    """
    check_writable(out)
    if out.exists() and not replace:
        raise InputError("there is a file already", file=out, expected="another name, or --replace")
    beside = out.with_name(f".{secrets.token_hex(6)}.part")
    try:
        os.close(os.open(beside, os.O_RDWR | os.O_CREAT | os.O_EXCL, FILE_MODE))
        if database.file is not None:
            with (
                closing(sqlite3.connect(database.file)) as source,
                closing(sqlite3.connect(beside)) as target,
            ):
                source.backup(target, pages=_PAGES)
        copy = Database(sqlite_url(beside))
        with contextlib.closing(copy), copy.begin() as to:
            if database.file is None:
                with database.snapshot() as of:
                    _copy(of, to)
            _CONTENT.create(to)
            counted = _write_content(to)
        with closing(sqlite3.connect(beside)) as raw:
            raw.execute("PRAGMA journal_mode=DELETE")  # one file, nothing beside it
        check(beside)
        beside.replace(out)
    except (OSError, sqlite3.Error) as error:
        said = getattr(error, "strerror", None) or one_line(str(error), 120)
        raise FileFormatError(f"cannot be written ({said})", file=out) from None
    finally:
        for end in ("", "-wal", "-shm", "-journal"):
            beside.with_name(beside.name + end).unlink(missing_ok=True)
    return counted


def check(path: Path) -> dict[str, int]:
    """Looks at a whole backup: table -> rows.

    Raises:
        FileFormatError: it is none, or damaged.
    """
    check_readable(path, "a backup")
    try:
        with closing(sqlite3.connect(f"file:{_quoted(path)}?mode=ro", uri=True)) as raw:
            if raw.execute("PRAGMA integrity_check(1)").fetchone() != ("ok",):
                raise FileFormatError("the backup is damaged", file=path, expected="another backup")
            if raw.execute("SELECT 1 FROM sqlite_master WHERE name = ?", (_CONTENT.name,)).fetchone() is None:
                raise FileFormatError(
                    "no backup", file=path, expected="a file that `teachframe backup` wrote"
                )
            listed = raw.execute("SELECT name, rows, sha256 FROM backup_content").fetchall()
            for name, rows, sha256 in listed:
                columns = [f'"{c[1]}"' for c in raw.execute(f'PRAGMA table_info("{name}")')]
                found = raw.execute(f'SELECT {", ".join(columns)} FROM "{name}"') if columns else ()
                if (rows, sha256) != _digest(found):
                    raise FileFormatError(
                        f"the table {name} is damaged", file=path, expected="another backup"
                    )
    except sqlite3.Error as error:
        raise FileFormatError(
            f"cannot be read as a backup ({one_line(str(error), 100)})",
            file=path,
            expected="a file that `teachframe backup` wrote",
        ) from None
    return {name: rows for name, rows, _ in listed}


def restore(path: Path, database: Database, *, replace: bool = False) -> dict[str, int]:
    """Puts a backup's content into a database, all of it or nothing.

    Args:
        path: the backup; it is checked first and stays as it is.
        database: where to; no server is to work on it meanwhile.
        replace: True takes the place of what is there.

    Returns:
        Table -> rows.

    Raises:
        InputError: no backup, a damaged one, one of a later version, or a database that is not empty.
        StorageError: the database did not take it.
    """
    check(path)
    with tempfile.TemporaryDirectory(prefix="teachframe-restore-") as folder:
        own = Path(folder) / "backup.sqlite"
        shutil.copyfile(path, own)
        source = Database(sqlite_url(own))  # brought to the newest tables, where it is older
        with contextlib.closing(source), source.begin() as of, database.begin() as to:
            held = [f"{n} {name}" for name, n in _held(to).items()]
            if held and not replace:
                raise InputError(
                    f"the database is not empty ({', '.join(held[:6])})",
                    file=database.name,
                    expected="--replace",
                )
            make_anew(to, {*_tables(of), *_PASSING} - {_CONTENT.name}, database.name)
            _copy(of, to)
            wanted = {name: _digest_of(of, table) for name, table in _tables(of).items()}
            if {name: _digest_of(to, table) for name, table in _tables(to).items()} != wanted:
                raise InputError(
                    "what arrived differs from the backup; nothing was changed", file=database.name
                )
            return {name: rows for name, (rows, _) in wanted.items()}


def _tables(connection: Connection) -> dict[str, Table]:
    metadata = MetaData()
    metadata.reflect(connection, only=lambda name, _: name not in _PASSING)
    return {name: metadata.tables[name] for name in sorted(metadata.tables)}


def _held(connection: Connection) -> dict[str, int]:
    """Tables that hold somebody's work, with their rows."""
    counts = {
        name: connection.execute(select(func.count()).select_from(table)).scalar_one()
        for name, table in _tables(connection).items()
        if name not in _EMPTY
    }
    return {name: count for name, count in counts.items() if count}


def _copy(of: Connection, to: Connection) -> None:
    there = inspect(to)
    for name, table in _tables(of).items():
        if not there.has_table(name):
            raise InputError(f"the table {name} is not one of this version's", expected="a backup of it")
        for rows in _batches(of, table):
            to.execute(insert(table), rows)
        if to.dialect.name == "postgresql":
            _go_on_counting(to, table)


def _batches(of: Connection, table: Table) -> Iterator[list[dict[str, object]]]:
    for rows in of.execute(_all(table)).mappings().partitions():
        yield [dict(row) for row in rows]


def _go_on_counting(to: Connection, table: Table) -> None:
    """Numbers that PostgreSQL gives go on behind those that were copied."""
    for column in table.primary_key:
        named = {"table": f'"{table.name}"', "column": column.name}
        counter = text("SELECT pg_get_serial_sequence(:table, :column)")
        sequence = to.execute(counter, named).scalar()
        last = to.execute(select(func.max(column))).scalar()
        if sequence is not None and last is not None:
            to.execute(text("SELECT setval(:sequence, :last)"), {"sequence": sequence, "last": last})


def _write_content(connection: Connection) -> dict[str, int]:
    counted = {}
    for name, table in _tables(connection).items():
        rows, sha256 = _digest_of(connection, table)
        line = {"name": name, "rows": rows, "sha256": sha256, "program": __version__}
        connection.execute(insert(_CONTENT), line)
        counted[name] = rows
    return counted


def _digest_of(connection: Connection, table: Table) -> tuple[int, str]:
    return _digest(connection.execute(_all(table)))


def _digest(rows) -> tuple[int, str]:
    """Number of rows and the sum of their SHA-256, in whichever order they come: databases sort words in their own
    ways. A truth is 0 or 1, as SQLite has it."""
    whole = count = 0
    for row in rows:
        plain = [int(value) if isinstance(value, bool) else value for value in row]
        whole += int.from_bytes(hashlib.sha256(msgspec.json.encode(plain)).digest())
        count += 1
    return count, f"{whole % (1 << 256):064x}"


def _all(table: Table):
    return select(table).execution_options(yield_per=_AT_ONCE)


def _quoted(path: Path) -> str:
    return quote(str(path.absolute()))
