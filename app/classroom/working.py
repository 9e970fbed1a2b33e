"""What somebody does now: working, stuck, stopped, finished, away. Pure; the one place that says who is stuck.

Somebody is stuck when a lesson runs and for STUCK seconds nothing in it got further. What gets a lesson further:

- an action that adds to it: a point recorded or recorded again, a calculation, a tool accepted, another mode, a
  measurement, a next step. Moves, comments, deleting and undoing add nothing;
- a motion that brings the tip nearer to the spike than it was since the last such action, by NEARER at least;
- a motion that turns the hand into an orientation it has not been in since the last such action, TURNED away from all
  of those. At most _TURNS of them count: who only turns the hand about without touching is stuck, too;
- on a stroke, a motion that leads farther from where the last point was recorded, by FARTHER at least.

So a hand that jogs to and fro, or rests, does not count as work, and slow careful work does.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from app.session.actions import (
    Accept,
    AnyAction,
    Begin,
    Calculate,
    ChooseMethod,
    ChooseMode,
    Enter,
    LoadPoints,
    Record,
    ReRecord,
    Tracked,
    TrackerNext,
)
from app.units import from_deg, from_mm

State = Literal["working", "stuck", "stopped", "finished", "waiting", "away"]
#: All of them, those that want a trainer first.
STATES: tuple[State, ...] = ("stuck", "stopped", "working", "waiting", "finished", "away")
#: Seconds without getting further after which somebody is stuck: three minutes is the time trainers give somebody to
#: find out by himself, and longer than the slowest single jog across the cell takes at T1 speed (2.6 m at 250 mm/s,
#: with pauses).
STUCK = 180.0
#: The tip came nearer by so much [m]: more than a hand trembles, less than the last careful steps to the spike.
NEARER = from_mm(0.5)
#: An orientation is another one from here on [rad]: half of what two touches should differ at least.
TURNED = from_deg(20.0)
#: A stroke leads on by so much [m].
FARTHER = from_mm(5.0)
_TURNS = 6

_ADDING = (
    Accept,
    Begin,
    Calculate,
    ChooseMethod,
    ChooseMode,
    Enter,
    LoadPoints,
    Record,
    ReRecord,
    Tracked,
    TrackerNext,
)


@dataclass(frozen=True)
class Glance:
    """What is seen of a session at one moment.

    Args:
        at: seconds that only grow.
        page: a page shows the session.
        stopped: the emergency stop is latched.
        exercise: key of the exercise that runs; empty where none does.
        finished: the last exercise in this session has ended.
        new: actions since the glance before.
        distance: true tip to true spike [m]; infinite where there is none.
        rotation: (3, 3) of the flange in the base.
        position: (3,) of the flange in the base [m].
        stroke: the step at hand is a stroke.
    """

    at: float
    page: bool
    stopped: bool
    exercise: str
    finished: bool
    new: tuple[AnyAction, ...]
    distance: float
    rotation: np.ndarray
    position: np.ndarray
    stroke: bool = False


@dataclass
class Watch:
    """Follows one session from glance to glance.

    Attributes:
        state, since: what its person does, and from when on (the clock of the glances).
    """

    state: State = "waiting"
    since: float = 0.0
    _further: float = field(default=-np.inf, repr=False)  # when something got further last
    _nearest: float = field(default=np.inf, repr=False)
    _been: list[np.ndarray] = field(default_factory=list, repr=False)
    _turns: int = field(default=0, repr=False)
    _from: np.ndarray | None = field(default=None, repr=False)
    _led: float = field(default=0.0, repr=False)

    def see(self, now: Glance) -> State:
        """What he does, after this glance."""
        if self._added(now.new) or self._from is None:
            self._begin(now)
        elif self._led_on(now):
            self._further = now.at
        state = self._state(now)
        if state != self.state or self.since == 0.0:
            self.state, self.since = state, self._further if state == "stuck" else now.at
        return self.state

    def _state(self, now: Glance) -> State:
        if not now.page:
            return "away"
        if now.stopped:
            return "stopped"
        if not now.exercise:
            return "finished" if now.finished else "waiting"
        return "stuck" if now.at - self._further >= STUCK else "working"

    def _added(self, new: Iterable[AnyAction]) -> bool:
        return any(isinstance(action, _ADDING) for action in new)

    def _begin(self, now: Glance) -> None:
        """Something was added: what counts as further is measured from here."""
        self._further, self._nearest = now.at, now.distance
        self._been, self._turns = [now.rotation], 0
        self._from, self._led = now.position, 0.0

    def _led_on(self, now: Glance) -> bool:
        further = False
        if now.distance < self._nearest - NEARER:
            self._nearest, further = now.distance, True
        if self._turns < _TURNS and all(_angle(now.rotation, been) > TURNED for been in self._been):
            self._been.append(now.rotation)
            self._turns += 1
            # Another way to touch begins: coming near counts from where the tip is now.
            self._nearest, further = now.distance, True
        if now.stroke and self._from is not None:
            led = float(np.linalg.norm(now.position - self._from))
            if led > self._led + FARTHER:
                self._led, further = led, True
        return further


def _angle(a: np.ndarray, b: np.ndarray) -> float:
    """Between two orientations [rad]."""
    return float(np.arccos(np.clip((np.trace(a.T @ b) - 1.0) / 2.0, -1.0, 1.0)))
