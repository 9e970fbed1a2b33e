"""A progress line on stderr, where a person watches; nothing where stderr goes to a file."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeElapsedColumn


class Shown:
    """What a command says while it works: `update` has the shape of app.diagnosis.result.Progress."""

    def __init__(self, console: Console, bar: Progress | None):
        self._console, self._bar = console, bar
        self._task = bar.add_task("", total=1.0) if bar else None

    @property
    def watched(self) -> bool:
        """True where a person sees the line."""
        return self._bar is not None

    def update(self, share: float, doing: str) -> None:
        """Shows the share done (0..1) and what is being done."""
        if self._bar is not None and self._task is not None:
            self._bar.start()
            self._bar.update(self._task, completed=share, description=doing)

    def pause(self) -> None:
        """Takes the line away, so that a result can be printed; the next update brings it back."""
        if self._bar is not None:
            self._bar.stop()

    def line(self, text: str) -> None:
        """One plain line on stderr."""
        self.pause()
        print(text, file=sys.stderr, flush=True)


@contextmanager
def shown_progress(files: int = 1) -> Iterator[Shown]:
    """A bar for the length of the block; silent unless stderr is a terminal."""
    console = Console(stderr=True)
    if not console.is_terminal:
        yield Shown(console, None)
        return
    bar = Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        TaskProgressColumn(),
        TimeElapsedColumn(),
        console=console,
        transient=True,
    )
    shown = Shown(console, bar)
    try:
        shown.update(0.0, "reading" if files == 1 else f"{files} recordings")
        yield shown
    finally:
        bar.stop()
