"""Gives somebody another role."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import tyro

from app.cli.accounts.base import BY, Kept


@dataclass(kw_only=True)
class Role(Kept):
    """Gives somebody another role; he has to log in anew."""

    login: tyro.conf.Positional[str]
    """Whose."""
    role: tyro.conf.Positional[Literal["trainee", "trainer", "administrator"]]
    """The new one."""

    def run(self) -> int:
        people = self.people
        person = people.change(people.find(self.login).id, by=BY, role=self.role)
        print(f"{person.login}: {person.role}")
        return 0
