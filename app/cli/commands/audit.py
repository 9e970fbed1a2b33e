"""Reads the audit log: what was done with accounts, classes and sessions, and by whom."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path


@dataclass
class Command:
    """Reads the audit log: what was done with accounts, classes and sessions, and by whom. The newest stands last.

    The log only grows, and holds ids; `--person` takes a log-in name, and names are put to ids that still have one.
    """

    person: str | None = None
    """Log-in name or id: only what this person did, or what was done to him."""
    after: int = 0
    """Only entries with a higher number."""
    most: int = 1000
    """So many at most, the newest."""
    json: bool = False
    """One JSON object an entry instead of the table."""
    data: Path | None = None
    """The data folder the pendant is started with; without it the user's own."""
    database: str | None = None
    """URL of the database the pendant is started with; without it the one in the data folder."""

    def run(self) -> int:
        import msgspec

        from app.cli.accounts.base import table
        from app.errors import InputError
        from app.people import People
        from app.session import Store
        from app.session.report import moment

        if self.most < 1:
            raise InputError(f"{self.most} entries", column="--most", expected="1 or more")
        people = People(Store(self.data, self.database).database)
        names = {person.id: person.login for person in people.list()}
        ids = {login: id for id, login in names.items()}
        person = None if self.person is None else ids.get(self.person, self.person)
        entries = people.audit.read(person=person, after=self.after, most=self.most)[::-1]
        if self.json:
            for entry in entries:
                print(msgspec.json.encode(entry).decode())
            return 0
        if not entries:
            print("nothing yet", file=sys.stderr)
            return 0
        rows = [("number", "when", "who", "did", "about")]
        for e in entries:
            when = moment(e.at, "%Y-%m-%d %H:%M:%S")
            who, about = names.get(e.person, e.person) or "-", names.get(e.about, e.about)
            rows.append((str(e.id), when, who, e.deed, about))
        print(table(rows))
        return 0
