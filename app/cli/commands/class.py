"""Classes: make, list, members, code and trainer, delete."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import tyro

from app.cli.accounts.class_change import Change
from app.cli.accounts.class_delete import Delete
from app.cli.accounts.class_list import List
from app.cli.accounts.class_make import Make
from app.cli.accounts.class_members import Members

_named = tyro.conf.subcommand


@dataclass
class Command:
    """Classes: make, list, members, code and trainer, delete.

    A trainee comes in by the class's code with a name and a PIN of his own (docs/class.md).
    """

    do: tyro.conf.OmitSubcommandPrefixes[
        Annotated[Make, _named("make")]
        | Annotated[List, _named("list")]
        | Annotated[Members, _named("members")]
        | Annotated[Change, _named("change")]
        | Annotated[Delete, _named("delete")]
    ]
    """What to do."""

    def run(self) -> int:
        return self.do.run()
