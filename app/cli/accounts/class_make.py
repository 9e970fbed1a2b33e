"""Makes a class."""

from __future__ import annotations

from dataclasses import dataclass

import tyro

from app.cli.accounts.base import BY, Kept
from app.people.refusals import refused


@dataclass(kw_only=True)
class Make(Kept):
    """Makes a class and says its code."""

    name: tyro.conf.Positional[str]
    """What it is called."""
    trainer: str
    """Log-in name of who trains it."""

    def run(self) -> int:
        people = self.people
        trainer = people.find(self.trainer)
        if not people.may(trainer, "class_make"):
            raise refused("no_trainer", login=trainer.login)
        made = people.classes.make(self.name, trainer.id)
        people.audit.note(BY, "class_make", made.id)
        print(f"{made.name}: {made.code}")
        return 0
