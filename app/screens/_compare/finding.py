"""'Find what is missing': the search in a process of its own, its progress, and the button that stops it."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from app.apart import SEARCH, GivenUpError, apart
from app.diagnosis.result import Diagnosis
from app.panel import markup as html
from app.screens._compare.jobs import search
from app.screens._compare.loaded import Loaded
from app.texts import FALLBACK, has_text

if TYPE_CHECKING:
    from app.screens.context import Context

_BETWEEN = 0.1  # seconds between two updates of the bar


class Search:
    """Button, bar and stop button.

    Args:
        context: where they stand.
        what: gives the recording to search, or None.
        found: called on the worker with the recording that was searched and its diagnosis.
    """

    def __init__(
        self,
        context: Context,
        what: Callable[[], Loaded | None],
        found: Callable[[Loaded, Diagnosis], None],
    ):
        self._context, self._what, self._found = context, what, found
        ui, t = context.ui, context.t
        self.button = ui.add_button(t("compare.find"), visible=False)
        self.bar = ui.add_progress(visible=False)
        self.doing = ui.add_html("", visible=False)
        self.cancel = ui.add_button(t("compare.cancel"), visible=False, rank="plain")
        context.clicked(self.button, self._start)
        # Not through the worker's queue: stopping must not wait behind anything.
        self._stop = threading.Event()

        self.cancel.heard = lambda _: self._stop.set()

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
        if not self._context.shelf.may_search():
            self._context.say("warning", self._context.t("compare.too_many"))
            return
        stop = self._stop = threading.Event()
        self._busy(True)
        last = 0.0

        def say(share: float, doing: str) -> None:
            nonlocal last
            if time.monotonic() - last >= _BETWEEN:
                last = time.monotonic()
                self._context.worker.latest("compare.progress", lambda: self._show(share, doing))

        def job() -> Diagnosis | Exception:
            asked = (loaded.path, loaded.named, loaded.model)
            try:
                return apart(search, *asked, bounds=SEARCH, say=say, stop=stop)
            except Exception as error:
                return error

        def done(result: Diagnosis | Exception) -> None:
            self._busy(False)
            if stop.is_set() or isinstance(result, GivenUpError):
                self._context.say("info", self._context.t("compare.cancelled"))
                return
            if isinstance(result, Exception):
                raise result
            self._found(loaded, result)

        self._context.background(job, done)

    def _show(self, share: float, doing: str) -> None:
        self.bar.value = 100.0 * max(0.0, min(1.0, share))
        key = f"doing.{doing.replace(' ', '_')}"
        said = self._context.t(key) if has_text(key, FALLBACK) else doing
        self.doing.content = html.paragraph(said, faint=True, testid="compare-doing")

    def _busy(self, busy: bool) -> None:
        self.button.visible = not busy
        self.bar.visible = self.doing.visible = self.cancel.visible = busy
        if busy:
            self._show(0.0, "")
