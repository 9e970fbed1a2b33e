"""What somebody does on the panel, put into the session's worker: on the server's thread nothing else happens."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from app.panel import Handle, Upload
from app.session.motion.worker import Job, Worker


class Hearing:
    """Connects widgets with jobs.

    Args:
        worker: on whose thread the jobs run.
    """

    def __init__(self, worker: Worker):
        self._worker = worker

    def clicked(self, button: Handle, job: Job) -> None:
        """Runs `job` for each click."""
        button.heard = lambda _: self._worker.post(job)

    def chosen(self, group: Handle, job: Callable[[str], object]) -> None:
        """Runs `job` with what was pressed in a row of buttons or a list."""
        group.heard = lambda value: self._worker.post(lambda: job(value))

    def changed(self, widget: Handle, slot: str, job: Callable[[Any], object]) -> None:
        """Runs `job` with the newest value somebody entered; what the program sets does not count."""
        widget.heard = lambda value: self._worker.latest(slot, lambda: job(value))

    def uploaded(self, widget: Handle, job: Callable[[tuple[Upload, ...]], object]) -> None:
        """Runs `job` with files somebody sent; they are gone when it returns."""

        def heard(sent: tuple[tuple[Upload, ...], Callable[[], None]]) -> None:
            files, done = sent

            def run() -> None:
                try:
                    job(files)
                finally:
                    done()

            self._worker.post(run)

        widget.heard = heard
