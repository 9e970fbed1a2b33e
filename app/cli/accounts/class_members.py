"""Who is in a class; who comes in, who goes."""

from __future__ import annotations

from dataclasses import dataclass

import tyro

from app.cli.accounts.base import BY, Kept, table


@dataclass(kw_only=True)
class Members(Kept):
    """Lists who is in a class; puts somebody in, takes somebody out."""

    at: tyro.conf.Positional[str]
    """The class, by its name or code."""
    add: str | None = None
    """Log-in name of whom to put in."""
    dismiss: str | None = None
    """Log-in name of whom to take out; his account and work stay."""

    def run(self) -> int:
        people = self.people
        at = people.classes.find(self.at)
        if self.add is not None:
            people.classes.enroll(at.id, people.find(self.add).id)
            people.audit.note(BY, "class_enroll", at.id)
        if self.dismiss is not None:
            people.classes.dismiss(at.id, people.find(self.dismiss).id)
            people.audit.note(BY, "class_dismiss", at.id)
        found = [p for p in map(people.get, people.classes.members(at.id)) if p is not None]
        print(table([("name", "log-in"), *((p.name, p.login) for p in found)]) if found else "nobody yet")
        return 0
