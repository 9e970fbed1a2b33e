"""Adds an account."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from typing import Literal

import tyro

from app.cli.accounts.base import BY, Kept, typed_secret
from app.errors import InputError


@dataclass(kw_only=True)
class Add(Kept):
    """Adds an account; its password is asked for, or comes on stdin."""

    login: tyro.conf.Positional[str]
    """What the person types to log in."""
    name: str | None = None
    """What others see; without it the log-in name."""
    role: Literal["trainee", "trainer", "administrator"] = "trainee"
    """What the person may do (docs/doors.md)."""

    def run(self) -> int:
        from app.people.person import fit_login

        people, login = self.people, fit_login(self.login)
        if self.role != "administrator" and not people.any():
            raise InputError(
                "the first account is an administrator's", column="--role", expected="administrator"
            )
        first = not people.any()
        person = people.add(login, self.name or login, self.role, typed_secret("password"), by=BY)
        print(f"{person.login}: {person.role}")
        if first:
            said = "teachframe people: a pendant that runs already asks for log-ins once it is started again"
            print(said, file=sys.stderr)
        return 0
