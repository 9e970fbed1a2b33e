"""A recording on its way in: what is being read, how far it is, and the button that gives it up."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from app.apart import RECORDING, GivenUpError, apart
from app.panel import markup as html
from app.screens._compare.jobs import Arrived

if TYPE_CHECKING:
    from app.screens.context import Context


class Reading:
    """One recording at a time is read, in a process of its own; another one takes its place.

    Args:
        context: where it stands.
        arrived: called on the worker with what was read.
    """

    def __init__(self, context: Context, arrived: Callable[[Arrived], None]):
        self._context, self._arrived = context, arrived
        self._stop = threading.Event()
        ui = context.ui
        self._words = ui.add_html("", visible=False)
        self._bar = ui.add_progress(visible=False)
        self._cancel = ui.add_button(context.t("compare.cancel_reading"), rank="plain", visible=False)
        # Not through the worker's queue: giving up must not wait behind anything.
        self._cancel.heard = lambda _: self._stop.set()

    def start(self, words: str, job: Callable[..., Arrived], *args: Any) -> None:
        """Begins to read; on the worker.

        Args:
            words: what is done, for the operator.
            job: of jobs.py, called with `args` in the other process.
        """
        self.stop()
        stop = self._stop = threading.Event()
        self._show(words, 0.0)
        self._context.say("info", words)

        def say(share: float, doing: str) -> None:
            if not stop.is_set():
                self._context.worker.latest("compare.reading", lambda: self._far(stop, words, share, doing))

        def run() -> Arrived | Exception:
            try:
                return apart(job, *args, bounds=RECORDING, say=say, stop=stop)
            except Exception as error:
                return error

        self._context.background(run, lambda found: self._done(stop, found))

    def stop(self) -> None:
        """What is being read is given up; its process ends."""
        self._stop.set()

    def _done(self, stop: threading.Event, found: Arrived | Exception) -> None:
        if stop is not self._stop:  # another one is being read
            return
        self._show("", None)
        if stop.is_set() or isinstance(found, GivenUpError):
            self._context.say("info", self._context.t("compare.reading_cancelled"))
            return
        if isinstance(found, Exception):
            raise found
        self._arrived(found)

    def _far(self, stop: threading.Event, words: str, share: float, doing: str) -> None:
        if stop is self._stop and self._bar.visible:
            said = self._context.t(f"doing.{doing.replace(' ', '_')}")
            self._show(f"{words} {said}, {100.0 * share:.0f}%", share)

    def _show(self, words: str, share: float | None) -> None:
        """Words and bar; None takes all away."""
        on = share is not None
        self._words.content = html.paragraph(words, testid="compare-reading")
        self._words.visible = self._bar.visible = self._cancel.visible = on
        self._bar.value = 100.0 * (share or 0.0)
