"""The state that moves, with its journal behind it."""

from __future__ import annotations

import threading
from pathlib import Path

from app.errors import ActionRefusedError, FileFormatError
from app.session.actions import AnyAction, ChooseRobot
from app.session.journal import Journal, read_journal
from app.session.reducer import reduce
from app.session.state import SessionState, first_state


class Session:
    """One person's work. Actions may come from any thread; each is done whole or not at all.

    Args:
        journal: where actions go before they count; None keeps nothing (tests, demonstrations).
        robot: the arm of a new session; None takes the usual one.
    """

    def __init__(self, journal: Journal | None = None, *, robot: str | None = None):
        self._journal = journal
        self._lock = threading.RLock()
        self.state = first_state()
        self.torn = self.closed = False
        if journal is not None:
            self.state = _replayed(journal.recorded.entries, journal.path)
            self.torn = journal.recorded.torn
        if (
            not self.state.count
        ):  # the arm stands in the journal, so that a change of the usual one changes nothing
            self.do(ChooseRobot(robot or self.state.robot))

    @property
    def name(self) -> str:
        """The session's name in its store; empty where nothing is kept."""
        return self._journal.recorded.header.session if self._journal else ""

    @property
    def path(self) -> Path:
        """The journal's file; only where there is one."""
        if self._journal is None:
            raise ValueError("this session keeps no journal")
        return self._journal.path

    def do(self, action: AnyAction) -> SessionState:
        """Does one action: first tried, then written, then taken over.

        Raises:
            ActionRefusedError: the state does not allow it; state and journal are as before.
        """
        with self._lock:
            after = reduce(self.state, action)
            if self._journal is not None:
                self._journal.append(action)
            self.state = after
            return after

    def close(self) -> None:
        """Closes the journal; the state can still be read."""
        self.closed = True
        if self._journal is not None:
            self._journal.close()


def replay(path: Path) -> tuple[SessionState, bool]:
    """The state a journal leads to, and whether its last line was torn.

    Raises:
        FileFormatError: not a journal, or an action the state before it does not allow.
    """
    recorded = read_journal(path)
    return _replayed(recorded.entries, path), recorded.torn


def _replayed(entries, path: Path) -> SessionState:
    state = first_state()
    for row, entry in enumerate(entries, 2):
        try:
            state = reduce(state, entry.action)
        except ActionRefusedError as error:
            raise FileFormatError(f"this action is not possible here ({error})", file=path, row=row) from None
    return state
