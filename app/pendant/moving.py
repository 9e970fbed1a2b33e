"""Where the arm of one pendant stands, and how it gets elsewhere: seen at once, written down when it rests."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator

import numpy as np

from app.pendant import motion
from app.pendant.inputs import Inputs
from app.pendant.jogging import Jogging
from app.pendant.page import Page
from app.pendant.stage import Stage
from app.pendant.trail import Trail
from app.pendant.worker import Job
from app.session import Session
from app.session.actions import Move
from app.session.state import as_tuple
from app.simulation.world import World

_SETTLED = 0.5  # seconds without motion after which where the arm stands is written down
_SHOWN = 0.1  # seconds between two updates of numbers while the arm moves


class Moving(Inputs):
    """The half of a pendant that moves its arm."""

    session: Session
    world: World
    jogging: Jogging
    stage: Stage
    page: Page
    q: np.ndarray
    trail: Trail
    _numbers_at = 0.0

    def go(self, q: np.ndarray, then: Job | None = None) -> None:
        """The arm moves to q (n,), visibly; `then` is done at the end."""
        self.tour([np.asarray(q, float)], lambda number: then() if then and number < 0 else None, 0.0)

    def tour(self, stops: list[np.ndarray], arrived: Callable[[int], object], rest: float = 0.5) -> None:
        """The arm goes through poses; `arrived` hears the number of each, and once more -1 at the end."""
        self.jogging.must_not_be_stopped()
        self.worker.animate("move", self._travel(stops, arrived, rest))
        self.page.numbers()

    def place(self, q: np.ndarray) -> None:
        """The arm stands at q (n,) at once, within its limits."""
        self.jogging.must_not_be_stopped()
        self.worker.halt("move")
        self.show(np.clip(q, self.world.robot.lower, self.world.robot.upper))
        self.worker.animate("settle", self._settle_later())

    def show(self, q: np.ndarray) -> None:
        """Draws the arm at q (n,); the numbers follow a little slower."""
        self.q = np.asarray(q, float)
        self.stage.pose(self.q, self.world)
        if self.session.state.running is not None:
            self.trail.passing(self.q)
        now = time.monotonic()
        if now - self._numbers_at >= _SHOWN:
            self._numbers_at = now
            self.worker.latest("numbers", self.page.numbers)  # after the scene, not before it
        else:
            self.worker.animate("numbers", self._numbers_later())

    def settle(self) -> None:
        """Writes down where the arm stands, where that is not yet done."""
        if as_tuple(self.q) != self.session.state.q:
            self.session.do(Move(as_tuple(self.q), self.trail.take()))

    def _travel(
        self, stops: list[np.ndarray], arrived: Callable[[int], object], rest: float
    ) -> Iterator[None]:
        for number, stop in enumerate(stops):
            yield from motion.move(self.q.copy(), stop, self.show)
            self.page.numbers()
            arrived(number)
            yield from motion.pause(rest)
        self.settle()
        self.post(lambda: arrived(-1))  # as a job of its own: by then the motion is over

    def _settle_later(self) -> Iterator[None]:
        yield from motion.pause(_SETTLED)
        self.settle()

    def _numbers_later(self) -> Iterator[None]:
        yield from motion.pause(_SHOWN)
        self._numbers_at = time.monotonic()
        self.page.numbers()
