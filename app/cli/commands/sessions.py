"""Lists the recorded pendant sessions, exports one to a file, takes one in from a file."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

NAME_SHOWN = 12  # characters: enough to tell sessions apart and to replay them by


@dataclass
class Command:
    """Lists the recorded pendant sessions, exports one to a file, takes one in from a file.

    Without arguments: the list, the newest first. `teachframe replay NAME` runs one again.
    """

    export: str | None = None
    """Name (or the beginning of it) of a session to write as a journal, one JSON line an action."""
    out: Path | None = None
    """File for --export; without it stdout."""
    take: Path | None = None
    """An exported journal to take in; the pendant then lists it with the others."""
    data: Path | None = None
    """The data folder the pendant was started with; without it the user's own."""
    database: str | None = None
    """URL of the database the pendant was started with; without it the one in the data folder."""
    json: bool = False
    """One JSON object a session instead of the table."""

    def run(self) -> int:
        from app.errors import InputError
        from app.files import write_bytes
        from app.session import Store, replay
        from app.session.arms import Arms
        from app.session.journal import encode_journal, read_journal

        if self.out is not None and self.export is None:
            raise InputError("nothing to write", column="--out", expected="--export NAME with it")
        store = Store(self.data, self.database)
        if self.take is not None:
            Arms(store.database).grant()
            recorded = read_journal(self.take)
            replay(recorded)  # what cannot be replayed is not taken in
            print(store.take(recorded))
            return 0
        if self.export is None:
            self._list(store)
            return 0
        recorded = store.find(self.export)
        content = encode_journal(recorded.header, recorded.entries)
        if self.out is None:
            sys.stdout.write(content.decode())
            return 0
        write_bytes(self.out, content)
        print(f"{self.out}: {len(recorded.entries)} actions", file=sys.stderr)
        return 0

    def _list(self, store) -> None:
        import msgspec

        from app.session.report import moment

        listed = store.list()
        if self.json:
            for session in listed:
                print(msgspec.json.encode(session).decode())
            return
        if not listed:
            print("no sessions yet")
            return
        print(f"{'session':<{NAME_SHOWN}}  {'began':<16}  {'last action':<16}  {'actions':>7}  robot")
        for session in listed:
            began, last = moment(session.created), moment(session.last)
            print(f"{session.name[:NAME_SHOWN]}  {began}  {last}  {session.actions:>7}  {session.robot}")
