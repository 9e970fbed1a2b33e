"""Everything kept about a person: as one zip for him, or erased.

Any table may hold something of his. By their columns' names they say so: `person` holds ids of people, `trainee` those
whose score it is, `owner` owner strings, `session` names of sessions; `trainer` and `author` say who made what belongs
to others by now, and keep his id. The tables are those that the database has: one that is added later is taken along
and erased as well. The audit log stays: it holds ids alone.
"""

from __future__ import annotations

import io
import zipfile
from collections.abc import Sequence
from typing import Any

import msgspec
from sqlalchemy import Connection, MetaData, Table, delete, or_, select

from app.people.people import People, Person
from app.people.tables import AUDIT, PEOPLE
from app.session.database import ACTIONS, SESSIONS
from app.session.journal import Header
from app.session.owners import OWNED

#: What proves who somebody is: nobody takes it along.
_NOT_GIVEN = {"secret", "hash", "outside"}


_BEGIN, _FINISH = '{"do":"begin"', '{"do":"finish"'
_RUNS = "An exercise runs in this session. Its actions are given once it has ended.\n"


def everything(people: People, person: Person, by: str) -> bytes:
    """A zip: a file of JSON lines a table, and each session as a journal that `teachframe replay` reads."""
    people.audit.note(by, "take_along", person.id)
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as out, people.database.begin() as connection:
        names = connection.scalars(select(OWNED.c.session).where(OWNED.c.owner == person.owner)).all()
        for name in names:
            head = connection.execute(select(SESSIONS).where(SESSIONS.c.name == name)).first()
            if head is None:
                continue
            rows = connection.execute(
                select(ACTIONS).where(ACTIONS.c.session == name).order_by(ACTIONS.c.n)
            ).all()
            given = _told(rows)
            if len(given) < len(rows):
                out.writestr(f"sessions/{name}.txt", _RUNS)
            lines = [msgspec.json.encode(Header(name, head.created)).decode()]
            lines += [f'{{"n":{n},"t":{t!r},"action":{action}}}' for _, n, t, action in given]
            out.writestr(f"sessions/{name}.jsonl", "\n".join(lines) + "\n")
        for table in _tables(connection):
            wanted = _his(table, person, list(names), ("trainer", "author"))
            if wanted is None or table.name in (ACTIONS.name, SESSIONS.name):
                continue
            rows = [
                msgspec.json.encode({k: v for k, v in row.items() if k not in _NOT_GIVEN})
                for row in connection.execute(select(table).where(wanted)).mappings()
            ]
            if rows:
                out.writestr(f"{table.name}.jsonl", b"\n".join(rows) + b"\n")
    return packed.getvalue()


def _told(rows: Sequence[Any]) -> Sequence[Any]:
    """A session's actions without those of an exercise that still runs: what is hidden in it follows from them."""
    for index in range(len(rows) - 1, -1, -1):
        if rows[index].action.startswith(_FINISH):
            break
        if rows[index].action.startswith(_BEGIN):
            return rows[:index]
    return rows


def erase(people: People, person: Person, by: str) -> int:
    """Erases everything but the audit log's ids; the number of sessions that are gone.

    Raises:
        PersonRefusedError: he is the last administrator, or has classes; nothing is erased.
    """
    people.must_be_erasable(person)
    with people.database.begin() as connection:
        names = list(connection.scalars(select(OWNED.c.session).where(OWNED.c.owner == person.owner)))
        for table in _tables(connection):
            wanted = None if table.name in (AUDIT.name, PEOPLE.name) else _his(table, person, names)
            if wanted is not None:
                connection.execute(delete(table).where(wanted))
        connection.execute(delete(PEOPLE).where(PEOPLE.c.id == person.id))
    people.audit.note(by, "erase", person.id)
    return len(names)


def _tables(connection: Connection) -> list[Table]:
    """The tables of the database, whichever modules are loaded."""
    found = MetaData()
    found.reflect(connection)
    return found.sorted_tables


def _his(table: Table, person: Person, sessions: list[str], made: tuple[str, ...] = ()) -> Any:
    """The condition for rows of a table that are his, and of those he made for others where columns in `made` say so;
    None where it holds nothing of anybody."""
    ways: dict[str, list[str]] = {
        "person": [person.id],
        "trainee": [person.id],
        "owner": [person.owner],
        "session": sessions,
        **{column: [person.id] for column in made},
    }
    if table.name == PEOPLE.name:
        ways = {"id": [person.id]}
    elif table.name == SESSIONS.name:
        ways = {"name": sessions}
    elif table.name == AUDIT.name:
        ways |= {"about": [person.id]}
    conditions = [table.c[column].in_(values) for column, values in ways.items() if column in table.c]
    return or_(*conditions) if conditions else None
