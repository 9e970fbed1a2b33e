"""'Find what is missing': the search on a thread of its own, its progress, and the button that stops it."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from app.diagnosis.result import Diagnosis
from app.errors import TeachframeError
from app.pendant import html
from app.pendant.screens._compare.loaded import Loaded, search
from app.pendant.texts import FALLBACK, has_text

if TYPE_CHECKING:
    from app.pendant.client import Pendant

_BETWEEN = 0.1  # seconds between two updates of the bar


class Search:
    """Button, bar and stop button.

    Args:
        pendant: where they stand.
        what: gives the recording to search, or None.
        found: called on the worker with the recording that was searched and its diagnosis.
    """

    def __init__(
        self,
        pendant: Pendant,
        what: Callable[[], Loaded | None],
        found: Callable[[Loaded, Diagnosis], None],
    ):
        self._pendant, self._what, self._found = pendant, what, found
        gui, t = pendant.client.gui, pendant.t
        self.button = gui.add_button(t("compare.find"), visible=False)
        self.bar = gui.add_progress_bar(0.0, visible=False, animated=True)
        self.doing = gui.add_html("", visible=False)
        self.cancel = gui.add_button(t("compare.cancel"), visible=False, color="gray")
        pendant.clicked(self.button, self._start)
        # Not through the worker's queue: stopping must not wait behind anything.
        self._stop = threading.Event()

        @self.cancel.on_click
        async def _(event) -> None:
            self._stop.set()

    @property
    def running(self) -> bool:
        """True while a search is on its way."""
        return bool(self.cancel.visible)

    def show(self, *, ready: bool) -> None:
        """The button, where there is something to search."""
        self.button.visible = ready and not self.running

    def stop(self) -> None:
        """Whatever runs ends at its next step; its result is dropped."""
        self._stop.set()

    def _start(self) -> None:
        loaded = self._what()
        if loaded is None or self.running:
            return
        stop = self._stop = threading.Event()
        self._busy(True)
        last = 0.0

        def say(share: float, doing: str) -> None:
            nonlocal last
            if time.monotonic() - last >= _BETWEEN:
                last = time.monotonic()
                self._pendant.worker.latest("compare.progress", lambda: self._show(share, doing))

        def job() -> Diagnosis | TeachframeError | None:
            try:
                return search(loaded, stop, say)
            except TeachframeError as error:
                return error

        def done(result: Diagnosis | TeachframeError | None) -> None:
            self._busy(False)
            if isinstance(result, TeachframeError):
                raise result
            if result is None or stop.is_set():
                self._pendant.say("info", self._pendant.t("compare.cancelled"))
                return
            self._found(loaded, result)

        self._pendant.background(job, done)

    def _show(self, share: float, doing: str) -> None:
        self.bar.value = 100.0 * max(0.0, min(1.0, share))
        key = f"doing.{doing.replace(' ', '_')}"
        said = self._pendant.t(key) if has_text(key, FALLBACK) else doing
        self.doing.content = html.paragraph(said, faint=True, testid="compare-doing")

    def _busy(self, busy: bool) -> None:
        self.button.visible = not busy
        self.bar.visible = self.doing.visible = self.cancel.visible = busy
        if busy:
            self._show(0.0, "")
