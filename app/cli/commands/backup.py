"""Writes sessions, scores and people into one file, while the pendant runs."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro


@dataclass
class Command:
    """Writes sessions, scores and people into one file, while the pendant runs.

    The file is the same for SQLite and PostgreSQL, checked when it is written, and for its owner alone.
    """

    file: Annotated[Path, tyro.conf.Positional]
    """The file to write."""
    data: Path | None = None
    """The data folder the pendant was started with; without it the user's own."""
    database: str | None = None
    """URL of the database the pendant was started with; without it the one in the data folder."""
    replace: Annotated[bool, tyro.conf.FlagCreatePairsOff] = False
    """Take the place of a file that is there."""

    def run(self) -> int:
        from app.session import Store
        from app.session.backup import back_up

        counted = back_up(Store(self.data, self.database).database, self.file, replace=self.replace)
        print(f"{self.file}: {said(counted)}; checked", file=sys.stderr)
        return 0


def said(counted: dict[str, int]) -> str:
    """Tables that hold something, with their rows."""
    return ", ".join(f"{name} {rows}" for name, rows in counted.items() if rows) or "nothing in it"
