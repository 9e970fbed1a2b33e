"""Which session belongs to which browser: a token in the browser's storage is the session's name."""

from __future__ import annotations

import threading
from typing import Protocol

from app.errors import TeachframeError
from app.session import Session, Store


class View(Protocol):
    """A browser's view of a session, as far as the hub needs it."""

    def taken_over(self) -> None:
        """Another tab will show this session: say so and let go before this returns."""
        ...


class Hub:
    """Hands every browser its session back; one view a session.

    Args:
        store: where sessions are kept.
        robot: arm of new sessions; None takes the usual one.
    """

    def __init__(self, store: Store, robot: str | None):
        self.store, self._robot = store, robot
        self._lock = threading.RLock()
        self._open: dict[str, Session] = {}
        self._views: dict[str, View] = {}

    def enter(self, token: str | None) -> tuple[Session, str]:
        """The session of this token, or a new one.

        Returns:
            The session, and how it was found: "new", "back", or "lost" where its journal can no longer be read.
        """
        with self._lock:
            if token and token in self._open:
                return self._open[token], "back"
            how = "new"
            session = None
            if token and self.store.has(token):
                try:
                    session, how = self.store.open(token), "back"
                except TeachframeError:
                    how = "lost"
            session = session or self.store.create(robot=self._robot)
            self._open[session.name] = session
            return session, how

    def claim(self, name: str) -> None:
        """Somebody else is about to show this session: whoever does so now has let go when this returns."""
        with self._lock:
            before = self._views.pop(name, None)
        if before is not None:
            before.taken_over()

    def show(self, name: str, view: View) -> None:
        """This view shows the session from now on; where another came between, that one lets go."""
        with self._lock:
            before = self._views.get(name)
            self._views[name] = view
        if before is not None and before is not view:
            before.taken_over()

    def leave(self, name: str, view: View) -> None:
        """The view is gone; the session's journal is closed unless another view shows it."""
        with self._lock:
            if self._views.get(name) is not view:
                return
            del self._views[name]
            session = self._open.pop(name, None)
        if session is not None:
            session.close()

    def in_use(self, name: str) -> bool:
        """True where a browser shows this session now."""
        return name in self._views

    def session(self, name: str) -> Session | None:
        """An open session by name."""
        return self._open.get(name)

    @property
    def names(self) -> list[str]:
        """Names of the open sessions."""
        return list(self._open)

    def view(self, name: str) -> View | None:
        """The view that shows a session."""
        return self._views.get(name)
