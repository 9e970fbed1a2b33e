"""Lists the classes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from app.cli.accounts.base import Kept
from app.cli.accounts.listing import show

if TYPE_CHECKING:
    from app.people.classes import Class


@dataclass(kw_only=True)
class List(Kept):
    """Lists the classes with their codes."""

    json: bool = False
    """One JSON object a class instead of the table."""

    def run(self) -> int:
        people = self.people

        def row(one: Class) -> tuple[str, ...]:
            trainer, members = people.get(one.trainer), people.classes.members(one.id)
            return one.name, one.code, trainer.login if trainer else "-", str(len(members))

        titles = ("class", "code", "trainer", "members")
        show(people.classes.list(), titles, row, nothing="no classes yet", json=self.json)
        return 0
