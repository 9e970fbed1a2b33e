"""Deletes a class."""

from __future__ import annotations

from dataclasses import dataclass

import tyro

from app.cli.accounts.base import BY, Kept


@dataclass(kw_only=True)
class Delete(Kept):
    """Deletes a class and its lessons; its members keep their accounts, sessions and scores."""

    at: tyro.conf.Positional[str]
    """The class, by its name or code."""

    def run(self) -> int:
        from app.classroom import Room

        people = self.people
        at = people.classes.find(self.at)
        Room(people.database).delete(at.id, BY)
        print(f"{at.name}: deleted")
        return 0
