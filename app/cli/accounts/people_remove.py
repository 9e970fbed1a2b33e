"""Shuts somebody out."""

from __future__ import annotations

from dataclasses import dataclass

import tyro

from app.cli.accounts.base import BY, Kept


@dataclass(kw_only=True)
class Remove(Kept):
    """Shuts somebody out at once; his work is kept (`erase` erases it, `reset` lets him in again)."""

    login: tyro.conf.Positional[str]
    """Whom."""

    def run(self) -> int:
        people = self.people
        person = people.change(people.find(self.login).id, by=BY, disabled=True)
        print(f"{person.login}: removed; sessions and scores are kept")
        return 0
