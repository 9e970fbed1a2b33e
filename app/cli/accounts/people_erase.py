"""Erases everything kept about somebody."""

from __future__ import annotations

import time
from dataclasses import dataclass

import tyro

from app.cli.accounts.base import BY, Kept
from app.errors import InputError

#: Seconds in which every server of this database has closed a page whose person was shut out.
_CLOSED = 6.0


@dataclass(kw_only=True)
class Erase(Kept):
    """Erases somebody with his sessions and scores for good; the audit log keeps his id alone."""

    login: tyro.conf.Positional[str]
    """Whom."""
    sure: bool = False
    """Said by who means it: nothing brings it back."""

    def run(self) -> int:
        from app.people.belongings import erase

        people = self.people
        person = people.find(self.login)
        if not self.sure:
            raise InputError(
                f"this erases {person.login} for good", column="--sure", expected="--sure, if you mean it"
            )
        people.must_be_erasable(person)
        people.change(person.id, by=BY, disabled=True)
        time.sleep(_CLOSED)  # a page that is open writes no more
        sessions = erase(people, person, BY)
        print(f"{person.login}: erased with {sessions} session{'' if sessions == 1 else 's'}")
        return 0
