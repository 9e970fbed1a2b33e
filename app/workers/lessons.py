"""A lesson that is opened, or begun, at the pendant of somebody: from a page beside it."""

from __future__ import annotations

from typing import Protocol, runtime_checkable

from app.training.exercise import Exercise
from app.workers.live import Live


@runtime_checkable
class _Lessons(Protocol):
    """The screen that has the exercises."""

    def choose(self, key: str) -> None:
        """An exercise is chosen."""
        ...

    def start(self, chosen: Exercise) -> None:
        """An exercise begins."""
        ...


def open_lesson(live: Live, chosen: Exercise, *, begin: bool = False) -> None:
    """The training screen opens with this exercise chosen; `begin` begins it at once, so that its maker tries it.

    While another exercise runs nothing is begun, and the message line says so.
    """
    context = live.context

    def job() -> None:
        training = next(view for view in context.views if isinstance(view, _Lessons))
        if begin:
            training.start(chosen)
        else:
            training.choose(chosen.key)
            context.open("training")

    context.post(job)
