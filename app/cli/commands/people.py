"""Accounts: add people, list them, give roles and passwords, shut out, export, erase."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import tyro

from app.cli.accounts.people_add import Add
from app.cli.accounts.people_erase import Erase
from app.cli.accounts.people_export import Export
from app.cli.accounts.people_list import List
from app.cli.accounts.people_remove import Remove
from app.cli.accounts.people_reset import Reset
from app.cli.accounts.people_role import Role

_named = tyro.conf.subcommand


@dataclass
class Command:
    """Accounts: add people, list them, give roles and passwords, shut out, export, erase.

    The first administrator: `teachframe people add NAME --role administrator`. Passwords are asked for, or come on
    stdin as one line; they are never an argument. docs/class.md shows a class from its first day on.
    """

    do: tyro.conf.OmitSubcommandPrefixes[
        Annotated[Add, _named("add")]
        | Annotated[List, _named("list")]
        | Annotated[Role, _named("role")]
        | Annotated[Reset, _named("reset")]
        | Annotated[Remove, _named("remove")]
        | Annotated[Export, _named("export")]
        | Annotated[Erase, _named("erase")]
    ]
    """What to do."""

    def run(self) -> int:
        return self.do.run()
