"""One line of the scorecard."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.intervals import Rate


@dataclass(frozen=True)
class Line:
    """One line of the scorecard.

    Args:
        key, title: what is counted.
        rate: how often it happened.
        aim: what it should be; `at_most` says in which direction.
    """

    key: str
    title: str
    rate: Rate
    aim: float | None = None
    at_most: bool = False
    also_at_most: float | None = None

    @property
    def met(self) -> bool | None:
        """Is the measured rate on the right side of its aim; None without an aim or a case."""
        value = self.rate.value
        if self.aim is None or value is None:
            return None
        if self.at_most:
            return value <= self.aim
        return value >= self.aim and (self.also_at_most is None or value <= self.also_at_most)
