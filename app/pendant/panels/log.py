"""What happened, with its time, the newest first."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from app.pendant import html
from app.session import SessionState

if TYPE_CHECKING:
    from app.pendant.client import Pendant

_SHOWN = 40


class _View:
    def __init__(self, pendant: Pendant):
        self._pendant = pendant
        self._html = pendant.client.gui.add_html("")
        self._last = -1.0

    def numbers(self) -> None:
        log = self._pendant.log
        last = log[-1][0] if log else 0.0
        if last == self._last:
            return
        self._last = last
        if not log:
            self._html.content = html.paragraph(self._pendant.t("log.empty"), faint=True, testid="log")
            return
        items = [
            (html.LEVELS[level], f"{time.strftime('%H:%M:%S', time.localtime(when))}  {words}")
            for when, level, words in reversed(log[-_SHOWN:])
        ]
        self._html.content = html.notes(items, testid="log")

    def refresh(self, state: SessionState) -> None:
        self.numbers()

    def close(self) -> None:
        pass


class _Log:
    key, order = "log", 20

    def build(self, pendant: Pendant) -> _View:
        return _View(pendant)


PANEL = _Log()
