"""The state that moves, with its journal behind it."""

from __future__ import annotations

import threading
import time

from app.errors import ActionRefusedError, FileFormatError
from app.session.actions import AnyAction, Begin, ChooseRobot, Finish
from app.session.journal import Entry, Journal, Recorded
from app.session.reducer import reduce
from app.session.state import SessionState, first_state

#: What arithmetic on numbers that nobody meant ends in.
_NOT_MEANT = (ValueError, TypeError, KeyError, IndexError, ArithmeticError, RecursionError)


class Session:
    """One person's work. Actions may come from any thread; each is done whole or not at all.

    Args:
        journal: where actions go before they count; None keeps nothing (tests, demonstrations).
        robot: the arm of a new session; None takes the usual one.
    """

    def __init__(self, journal: Journal | None = None, *, robot: str | None = None):
        self._journal = journal
        self._lock = threading.RLock()
        self.closed = False
        self._entries: list[Entry] = [] if journal is None else list(journal.recorded.entries)
        self._ended = next(filter(None, (_exam(entry.action) for entry in reversed(self._entries))), None)
        self.state = first_state() if journal is None else replay(journal.recorded)
        if (
            not self.state.count
        ):  # the arm stands in the journal, so that a change of the usual one changes nothing
            self.do(ChooseRobot(robot or self.state.robot))

    @property
    def name(self) -> str:
        """The session's name in its store; empty where nothing is kept."""
        return self._journal.recorded.header.session if self._journal else ""

    @property
    def entries(self) -> tuple[Entry, ...]:
        """All actions so far, with their times."""
        with self._lock:
            return tuple(self._entries)

    def since(self, number: int) -> tuple[Entry, ...]:
        """Actions after the first so many, with their times."""
        with self._lock:
            return tuple(self._entries[number:])

    @property
    def ended(self) -> Begin | Finish | None:
        """What began or ended an exercise last: a Begin or a Finish; None where there was none."""
        return self._ended

    def do(self, action: AnyAction) -> SessionState:
        """Does one action: first tried, then kept, then taken over.

        Raises:
            ActionRefusedError: the state does not allow it; state and journal are as before.
            StorageError: it could not be kept; state and journal are as before.
        """
        with self._lock:
            after = reduce(self.state, action)
            number = len(self._entries) + 1
            kept = (
                Entry(number, time.time(), action) if self._journal is None else self._journal.append(action)
            )
            self._entries.append(kept)
            self._ended = _exam(action) or self._ended
            self.state = after
            return after

    def close(self) -> None:
        """Closes the journal; the state can still be read."""
        self.closed = True
        if self._journal is not None:
            self._journal.close()


def _exam(action: AnyAction) -> Begin | Finish | None:
    return action if isinstance(action, Begin | Finish) else None


def replay(recorded: Recorded) -> SessionState:
    """The state a journal leads to.

    Raises:
        FileFormatError: an action the state before it does not allow.
    """
    state = first_state()
    for row, entry in enumerate(recorded.entries, recorded.first_row):
        try:
            state = reduce(state, entry.action)
        except ActionRefusedError as error:
            raise FileFormatError(
                f"this action is not possible here ({error})", file=recorded.source, row=row
            ) from None
        except (
            _NOT_MEANT
        ) as error:  # written by a hand or another program: it has the shape of an action only
            raise FileFormatError(
                f"this action cannot be done ({type(error).__name__})", file=recorded.source, row=row
            ) from None
    return state
