"""Another password or PIN, an account unlocked."""

from __future__ import annotations

from dataclasses import dataclass

import tyro

from app.cli.accounts.base import BY, Kept, typed_secret


@dataclass(kw_only=True)
class Reset(Kept):
    """Gives somebody another password, which unlocks the account and brings back who was removed.

    It is asked for, or comes on stdin.
    """

    login: tyro.conf.Positional[str]
    """Whose."""
    pin: bool = False
    """A PIN instead of a password: for who came by a class code."""

    def run(self) -> int:
        people = self.people
        person = people.find(self.login)
        new = typed_secret("PIN" if self.pin else "password")
        secret, pin = (None, new) if self.pin else (new, None)
        people.change(person.id, by=BY, disabled=False, secret=secret, pin=pin)
        print(f"{person.login}: changed; every browser has to log in anew")
        return 0
