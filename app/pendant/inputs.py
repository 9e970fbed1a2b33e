"""What a page's widgets start: every one only puts a job into the session's worker."""

from __future__ import annotations

import threading
import time
from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import Any

import viser

from app.pendant.typed import RESTED, Dragged
from app.pendant.worker import Job, Worker

_TYPED = "typed "  # timers of this name hold a value somebody may still be typing


class Inputs(ABC):
    """The half of a pendant that its widgets speak to."""

    worker: Worker

    def post(self, job: Job) -> None:
        """Puts a job into the worker's queue, from any thread."""
        self.worker.post(job)

    def clicked(self, button: Any, job: Job) -> None:
        """Runs `job` on the worker for each click."""

        @button.on_click
        async def _(event: viser.GuiEvent) -> None:
            self._typed_out()
            self.worker.post(job)

    def chosen(self, group: Any, job: Callable[[str], object]) -> None:
        """Runs `job` on the worker with the button of the group that was clicked."""

        @group.on_click
        async def _(event: viser.GuiEvent) -> None:
            value = event.target.value
            self._typed_out()
            self.worker.post(lambda: job(value))

    def changed(self, widget: Any, slot: str, job: Callable[[Any], object]) -> None:
        """Runs `job` on the worker with the newest value somebody entered; what the program sets does not count."""

        @widget.on_update
        async def _(event: viser.GuiEvent) -> None:
            if event.client is None:
                return
            value = event.target.value
            self._typed_out()
            self.worker.latest(slot, lambda: job(value))

    def entered(self, widget: Any, slot: str, job: Callable[[Any], object], *, slider: bool = False) -> None:
        """Like `changed` for what can be typed: half a number does not count, it has to rest; a drag counts at once.

        Args:
            slider: the values may come from a drag, too.
        """
        drag, name = Dragged(), _TYPED + slot

        @widget.on_update
        async def _(event: viser.GuiEvent) -> None:
            if event.client is None:
                return
            value = event.target.value
            self._typed_out(but=name)
            if slider and drag.hears(value, time.monotonic()):
                self.worker.halt(name)
                self.worker.latest(slot, lambda: job(value))
            else:
                self.worker.later(name, RESTED, lambda: job(value))

    def typing(self, slot: str) -> bool:
        """True while what stands in a field may be half a number."""
        return self.worker.waits(_TYPED + slot)

    def _typed_out(self, but: str = "") -> None:
        """Who does something else has typed to the end: it counts now, before what comes next."""
        self.worker.hasten(_TYPED, but)

    def background(self, job: Callable[[], Any], done: Callable[[Any], None]) -> None:
        """Long work on a thread of its own; `done` gets its result on the worker."""

        def run() -> None:
            try:
                result = job()
            except Exception as error:
                self.post(lambda error=error: self._tell(error))
            else:
                self.post(lambda: done(result))

        threading.Thread(target=run, name="pendant-background", daemon=True).start()

    @abstractmethod
    def _tell(self, error: Exception) -> None:
        """Tells the operator what failed."""
