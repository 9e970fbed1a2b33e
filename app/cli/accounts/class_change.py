"""Another code, another trainer, another name of a class."""

from __future__ import annotations

from dataclasses import dataclass

import tyro

from app.cli.accounts.base import BY, Kept
from app.people.refusals import refused


@dataclass(kw_only=True)
class Change(Kept):
    """Gives a class another code, trainer or name; without any of them it says what it has."""

    at: tyro.conf.Positional[str]
    """The class, by its name or code."""
    new_code: bool = False
    """The code so far lets nobody in any more."""
    trainer: str | None = None
    """Log-in name of who trains it from now on."""
    name: str | None = None
    """What it is called from now on."""

    def run(self) -> int:
        people = self.people
        at = people.classes.find(self.at)
        trainer = None if self.trainer is None else people.find(self.trainer)
        if trainer is not None and not people.may(trainer, "class_make"):
            raise refused("no_trainer", login=trainer.login)
        if trainer is not None or self.name is not None:
            people.classes.change(at.id, name=self.name, trainer=trainer.id if trainer else None)
            people.audit.note(BY, "class_change", at.id)
        if self.new_code:
            people.classes.new_code(at.id)
            people.audit.note(BY, "class_code", at.id)
        now = people.classes.find(at.id)
        who = people.get(now.trainer)
        print(f"{now.name}: {now.code}, trained by {who.login if who else '-'}")
        return 0
