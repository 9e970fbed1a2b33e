"""One line of the benchmark table, and how its seconds are taken."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """Ours beside a named peer, measured in the same run on the same machine.

    Args:
        name: what was done.
        ours: our figure, in `unit`; smaller is better.
        peer: the peer's; None where there is none or it is not installed.
        peer_name: who the peer is, with what makes the comparison fair.
        unit: "s", "mm", "MB", ...
        aim: what `ours` should stay below, in `unit`; None where there is none.
    """

    name: str
    ours: float
    peer: float | None = None
    peer_name: str = ""
    unit: str = "s"
    aim: float | None = None

    @property
    def ratio(self) -> float:
        """Ours over peer: below 1 ours is better."""
        return self.ours / self.peer if self.peer else float("nan")


def quickest(function: Callable[[], object], rounds: int) -> float:
    """Shortest of several calls [s]: processor time of this one-threaded process, whoever else is on the machine."""
    best = float("inf")
    for _ in range(rounds):
        start = time.process_time()
        function()
        best = min(best, time.process_time() - start)
    return best
