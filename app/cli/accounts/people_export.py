"""Everything kept about somebody, as a zip."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import tyro

from app.cli.accounts.base import BY, Kept


@dataclass(kw_only=True)
class Export(Kept):
    """Writes everything kept about somebody: his sessions as journals, the rest as JSON lines, in one zip."""

    login: tyro.conf.Positional[str]
    """Whose."""
    out: Path
    """The zip to write."""

    def run(self) -> int:
        from app.files import write_bytes
        from app.people.belongings import everything

        people = self.people
        content = everything(people, people.find(self.login), BY)
        write_bytes(self.out, content)
        print(f"{self.out}: {len(content)} bytes")
        return 0
