"""Puts a backup back: all of it or nothing; what is there is only replaced when told."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro


@dataclass
class Command:
    """Puts a backup back: all of it or nothing; what is there is only replaced when told.

    Stop the pendant first. A backup of an earlier version is brought to the tables of this one.
    """

    file: Annotated[Path, tyro.conf.Positional]
    """A file that `teachframe backup` wrote."""
    data: Path | None = None
    """The data folder; without it the user's own."""
    database: str | None = None
    """URL of the database; without it the one in the data folder."""
    replace: Annotated[bool, tyro.conf.FlagCreatePairsOff] = False
    """Take the place of everything that is there."""

    def run(self) -> int:
        from app.cli.commands.backup import said
        from app.session import Store
        from app.session.backup import check, restore

        check(self.file)  # before a data folder is made for it
        database = Store(self.data, self.database).database
        counted = restore(self.file, database, replace=self.replace)
        print(f"{database.name}: {said(counted)}", file=sys.stderr)
        return 0
