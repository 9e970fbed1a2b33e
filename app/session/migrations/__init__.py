"""The tables' history, one file a step under `versions/`, run by Alembic.

A new table or column is a new file `NNNN_what.py` with the next number as its revision; files that were released are
not changed any more, and import nothing of the program: it goes on, they stay. Alembic is imported only where a
database is not at the last step, so that a start stays quick.
"""

from __future__ import annotations

import re
import warnings
from pathlib import Path

from sqlalchemy import Connection, inspect, text

from app.errors import InputError

#: The table that says which step a database is at: Alembic's own.
VERSION = "alembic_version"
_FOLDER = Path(__file__).parent
_STEP = re.compile(r"(\d{4})_\w+\.py\Z")
#: Any number: who holds it on a PostgreSQL server makes the tables, others wait.
_LOCK = 0x7EAC


def steps() -> list[str]:
    """All steps, the first to the last."""
    found = (_STEP.match(path.name) for path in (_FOLDER / "versions").iterdir())
    return sorted(match[1] for match in found if match)


def upgrade(connection: Connection, name: str) -> None:
    """Brings a database to the last step, within the connection's transaction.

    Args:
        connection: of the database; whoever else would do the same waits.
        name: of the database, for the error.

    Raises:
        InputError: it was made by a later version.
    """
    if at(connection, name) == steps()[-1]:
        return
    kind = connection.dialect.name
    if kind == "sqlite" and not _begun(connection):
        connection.exec_driver_sql("BEGIN IMMEDIATE")
    elif kind == "postgresql":
        connection.execute(text("SELECT pg_advisory_xact_lock(:key)"), {"key": _LOCK})
    if at(connection, name) == steps()[-1]:  # another program was quicker
        return
    from alembic import command
    from alembic.config import Config

    config = Config()
    config.set_main_option("script_location", str(_FOLDER).replace("%", "%%"))
    config.set_main_option("path_separator", "os")
    config.attributes["connection"] = connection
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # those of Alembic are for developers
        command.upgrade(config, "head")
    if kind == "sqlite":  # for earlier versions of this program, which look at this number only
        connection.exec_driver_sql(f"PRAGMA user_version = {int(steps()[-1])}")


def make_anew(connection: Connection, tables: set[str], name: str) -> None:
    """Takes these tables away, with all that is in them, and makes all of the last step, in the connection's
    transaction."""
    if connection.dialect.name == "sqlite":
        connection.exec_driver_sql("BEGIN IMMEDIATE")
    for table in tables & set(inspect(connection).get_table_names()):
        connection.exec_driver_sql(f'DROP TABLE "{table}"')
    upgrade(connection, name)


def _begun(connection: Connection) -> bool:
    """True where SQLite is within a transaction already."""
    return bool(getattr(connection.connection.dbapi_connection, "in_transaction", False))


def at(connection: Connection, name: str) -> str:
    """The step a database is at; empty where there is none yet, or where the version before steps made it.

    Raises:
        InputError: a step that this version does not know.
    """
    if not inspect(connection).has_table(VERSION):
        return ""
    step = connection.execute(text(f"SELECT version_num FROM {VERSION}")).scalar() or ""
    if step and step not in steps():
        raise InputError(
            f"this database was made by a later version (schema {step})",
            file=name,
            expected=f"schema {steps()[-1]} or earlier; update teachframe, or choose another one",
        )
    return step
