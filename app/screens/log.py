"""What happened, with its time, the newest first."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from app.panel import markup as html
from app.session import SessionState

if TYPE_CHECKING:
    from app.screens.context import Context

_SHOWN = 60


class _View:
    def __init__(self, context: Context):
        self._context = context
        self._html = context.ui.add_html("")
        self._last = -1.0

    def numbers(self) -> None:
        """Something may have been said."""
        log = self._context.log
        last = log[-1][0] if log else 0.0
        if last == self._last:
            return
        self._last = last
        if not log:
            self._html.content = html.paragraph(self._context.t("log.empty"), faint=True, testid="log")
            return
        items = [
            (html.LEVELS[level], f"{time.strftime('%H:%M:%S', time.localtime(when))}  {words}")
            for when, level, words in reversed(log[-_SHOWN:])
        ]
        self._html.content = html.notes(items, testid="log")

    def refresh(self, state: SessionState) -> None:
        """The session changed."""
        self.numbers()

    def close(self) -> None:
        """Nothing is held."""


class _Log:
    key, order = "log", 95

    def build(self, context: Context) -> _View:
        """Makes the widgets."""
        return _View(context)


SCREEN = _Log()
