"""How far long work is: whoever does a part says how much of it is done, whoever waits hears it as a share of all.

Rows are read, and fits made, many calls below the screen that shows them, and rows only when a column is first asked
for. So who listens is not handed down: it stands in the context of the thread.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

Hear = Callable[[float, str], object]

_LISTENS: ContextVar[tuple[Hear, str] | None] = ContextVar("listens", default=None)


def done(share: float) -> None:
    """The work at hand is done to this share, 0..1; nothing where nobody listens."""
    if (listens := _LISTENS.get()) is not None:
        hear, doing = listens
        hear(min(max(share, 0.0), 1.0), doing)


@contextmanager
def listened(hear: Hear, doing: str) -> Iterator[None]:
    """`hear` is told what is done within, as a share that never falls, and what is being done."""
    most = 0.0

    def rising(share: float, doing: str) -> None:
        nonlocal most
        most = max(most, share)
        hear(most, doing)

    token = _LISTENS.set((rising, doing))
    try:
        yield
    finally:
        _LISTENS.reset(token)


@contextmanager
def part(start: float, end: float, doing: str = "") -> Iterator[None]:
    """What is done within is this part of the work around it; at its end that is done to `end`.

    Args:
        doing: what it is; empty where it is what the work around it is.
    """
    around = _LISTENS.get()
    if around is None:
        yield
        return
    hear, called = around
    token = _LISTENS.set((lambda share, doing: hear(start + (end - start) * share, doing), doing or called))
    try:
        done(0.0)
        yield
        done(1.0)
    finally:
        _LISTENS.reset(token)
