"""Where the arm of one pendant stands, and how it gets elsewhere: seen at once, written down when it rests."""

from __future__ import annotations

import time
from abc import abstractmethod
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from app.geometry import Pose
from app.pendant import motion
from app.pendant.guarding import guard_of, words
from app.pendant.inputs import Inputs
from app.pendant.jogging import Jogging
from app.pendant.page import Page
from app.pendant.stage import Stage
from app.pendant.trail import Trail
from app.pendant.worker import Job
from app.session import Session
from app.session.actions import Move
from app.session.state import as_tuple
from app.simulation.guard import Guard, Stop
from app.simulation.route import route
from app.simulation.world import World

_SETTLED = 0.5  # seconds without motion after which where the arm stands is written down
_SHOWN = 0.2  # seconds between two updates of numbers while the arm moves: they cost more than the arm itself


class Moving(Inputs):
    """The half of a pendant that moves its arm."""

    session: Session
    world: World
    jogging: Jogging
    stage: Stage
    page: Page
    q: np.ndarray
    trail: Trail
    language: str
    _numbers_at = 0.0
    _guard: Guard | None = None

    @abstractmethod
    def t(self, key: str, **fields: Any) -> str:
        """A text in the operator's language."""

    @abstractmethod
    def say(self, level: str, words: str) -> None:
        """The message line, and the log."""

    def go(self, q: np.ndarray, then: Job | None = None) -> None:
        """The arm moves to q (n,), visibly; `then` is done at the end."""
        self.tour([np.asarray(q, float)], lambda number: then() if then and number < 0 else None, 0.0)

    def tour(
        self,
        stops: list[np.ndarray],
        arrived: Callable[[int], object],
        rest: float = 0.5,
        *,
        checked: bool = True,
    ) -> None:
        """The arm goes through poses; `arrived` hears the number of each, and once more -1 at the end.

        Args:
            checked: each way is looked at first, and gone round what is in it; where none is free the tour ends and
                the operator hears why. False goes straight: for poses somebody has been at.
        """
        self.jogging.must_not_be_stopped()
        self.worker.animate("move", self._travel(stops, arrived, rest, checked))
        self.page.numbers()

    def place(self, q: np.ndarray) -> None:
        """The arm goes to q (n,) at once, within its limits, as far as nothing is hit."""
        self.jogging.must_not_be_stopped()
        self.worker.halt("move")
        stop = self.advance(np.clip(q, self.world.robot.lower, self.world.robot.upper))
        self.worker.later("settle", _SETTLED, self.settle)
        if stop is not None:
            self.say("warning", words(stop, self.t, self.language))

    def advance(self, q: np.ndarray) -> Stop | None:
        """The arm goes straight to q (n,) at once, or to what is in its way, which is given back."""
        at, stop = self.guard.advance(self.q, q)
        self.show(at)
        return stop

    @property
    def guard(self) -> Guard:
        """What keeps this arm from hitting anything."""
        if self._guard is None or self._guard.world is not self.world:
            self._guard = guard_of(self.world)
        return self._guard

    @property
    def T_flange_tool(self) -> Pose:
        """The tool the controller reckons with: the accepted one, else the cell's."""
        tool = self.session.state.tool
        return self.world.T_flange_tool_hand if tool is None else tool.T_flange_tool

    def hand(self, q: np.ndarray | None = None) -> Pose:
        """T_base_tool as the controller reckons it; q (n,), or where the arm stands."""
        return self.world.shown_flange(self.q if q is None else q) @ self.T_flange_tool

    def show(self, q: np.ndarray) -> None:
        """Draws the arm at q (n,); the numbers follow a little slower."""
        self.q = np.asarray(q, float)
        self.stage.pose(self.q, self.world, self.hand())
        if self.session.state.running is not None:
            self.trail.passing(self.q)
        now = time.monotonic()
        if now - self._numbers_at >= _SHOWN:
            self._numbers_at = now
            self.worker.latest("numbers", self.page.numbers)  # after the scene, not before it
        elif not self.worker.waits("numbers"):
            self.worker.later("numbers", _SHOWN, self._numbers_now)

    def settle(self) -> None:
        """Writes down where the arm stands, where that is not yet done."""
        if as_tuple(self.q) != self.session.state.q:
            self.session.do(Move(as_tuple(self.q), self.trail.take()))

    def _travel(
        self, stops: list[np.ndarray], arrived: Callable[[int], object], rest: float, checked: bool
    ) -> Iterator[None]:
        for number, stop in enumerate(stops):
            way = route(self.world, self.guard, self.q, stop) if checked else [stop]
            if isinstance(way, Stop):
                self.settle()
                why = words(way, self.t, self.language)
                self.say("warning", self.t("message.no_way", why=why))
                self.post(self.page.numbers)
                return
            for leg in way:
                yield from motion.move(self.q.copy(), leg, self.show)
            self.page.numbers()
            arrived(number)
            yield from motion.pause(rest)
        self.settle()
        self.post(self.page.numbers)  # as jobs of their own: by then the motion is over
        self.post(lambda: arrived(-1))

    def _numbers_now(self) -> None:
        self._numbers_at = time.monotonic()
        self.page.numbers()
