"""Where accounts are kept, and secrets: typed twice where somebody sits there, else a line of stdin."""

from __future__ import annotations

import getpass
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from app.errors import InputError

if TYPE_CHECKING:
    from app.people import People

#: Who does what is done at the command line, in the audit log: whoever may read the database.
BY = "command line"
_LONGEST = 4096  # characters of a line of stdin that is to be a secret


@dataclass(kw_only=True)
class Kept:
    """Where accounts are kept."""

    data: Path | None = field(default=None)
    """The data folder the pendant is started with; without it the user's own."""
    database: str | None = field(default=None)
    """URL of the database the pendant is started with; without it the one in the data folder."""

    @property
    def people(self) -> People:
        """The accounts."""
        from app.people import People
        from app.session import Store

        return People(Store(self.data, self.database).database)


def typed_secret(what: str) -> str:
    """A secret that is typed twice unseen, or the one line that comes on stdin; raises InputError."""
    if not sys.stdin.isatty():
        line = sys.stdin.readline(_LONGEST).rstrip("\r\n")
        if not line:
            raise InputError(
                f"no {what} came on stdin", expected=f"the {what} as one line, or a terminal to type it"
            )
        return line
    secret = getpass.getpass(f"{what}: ")
    if getpass.getpass(f"{what} again: ") != secret:
        raise InputError(f"the {what} was not typed the same twice")
    return secret


def table(rows: list[tuple[str, ...]]) -> str:
    """Rows under each other, the first of them the titles."""
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    return "\n".join(
        "  ".join(f"{cell:<{w}}" for cell, w in zip(row, widths, strict=True)).rstrip() for row in rows
    )
