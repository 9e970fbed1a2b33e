"""One line of the benchmark table."""

from __future__ import annotations

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
