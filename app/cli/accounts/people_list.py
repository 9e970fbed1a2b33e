"""Lists the accounts."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

from app.cli.accounts.base import Kept
from app.cli.accounts.listing import show

if TYPE_CHECKING:
    from app.people import Person


@dataclass(kw_only=True)
class List(Kept):
    """Lists the accounts by log-in name."""

    json: bool = False
    """One JSON object an account instead of the table."""

    def run(self) -> int:
        from app.session.report import moment

        def row(person: Person) -> tuple[str, ...]:
            locked = "locked" if person.locked_until > time.time() else ""
            state = "removed" if person.disabled else locked
            return person.login, person.name, person.role, moment(person.created), state

        titles = ("log-in", "name", "role", "since", "state")
        show(self.people.list(), titles, row, nothing="no accounts yet", json=self.json)
        return 0
