"""Hold-to-move: velocity integrated on the server by the clock, with an enabling switch that times out.

A browser says "still held", and once "let go". When it falls silent for `SILENCE` the arm stands, whatever the
browser believes. One press is one increment, however the words of the press stutter on their way.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import TYPE_CHECKING

from app.errors import ActionRefusedError
from app.pendant.jog_way import FRAMES, Jog, JogWay
from app.units import from_deg, from_mm

if TYPE_CHECKING:
    from app.pendant.client import Pendant

__all__ = ["FRAMES", "INCREMENTS", "SILENCE", "TIP_SPEED", "Jog", "Jogging"]

SILENCE = 0.3  # seconds without a word from the browser after which the arm stands
FORGOTTEN = 1.5  # seconds of silence after which a held button counts as let go, where nobody said so
TIP_SPEED = from_mm(250.0)  # manual speed at the tool point, m/s
TURN_SPEED = from_deg(30.0)  # rad/s of a joint, and about the tool point, at 100%
_LONGEST_TICK = 0.1  # seconds: a machine that stuttered does not leap

#: Increment -> length [m] and angle [rad]; None moves as long as the button is held.
INCREMENTS: dict[str, tuple[float, float] | None] = {
    "continuous": None,
    "large": (from_mm(10.0), from_deg(3.0)),
    "medium": (from_mm(1.0), from_deg(1.0)),
    "small": (from_mm(0.1), from_deg(0.1)),
}


class Jogging:
    """Moves one pendant's arm while a button is held and the enabling switch is on.

    Args:
        pendant: whose arm moves.
    """

    def __init__(self, pendant: Pendant):
        self._pendant = pendant
        self.enabled = self.stopped = False
        self.frame, self.increment, self.override = "joint", "continuous", 0.5
        self._held: Jog | None = None
        self._heard, self._silence = 0.0, SILENCE
        self._press = 0  # number of the press; belongs to the event loop
        self._spent: tuple[Jog, int] | None = None  # the press whose increment has begun

    def hear(self, jog: Jog, silence: float | None = None) -> None:
        """The button is (still) held; from the event loop: takes the time and enqueues.

        Args:
            silence: seconds without another word after which the arm stands; None: `SILENCE`.
        """
        heard = time.monotonic()
        if heard - self._heard > FORGOTTEN:  # another press, though nobody let go
            self._press += 1
        self._heard, self._silence = heard, SILENCE if silence is None else silence
        press = self._press
        self._pendant.worker.latest("jog", lambda: self._hold(jog, heard, press))

    def let_go(self) -> None:
        """The button was let go: the arm stands, but for an increment that is under way; from the event loop."""
        self._press += 1
        self._heard = -float("inf")

    def stop(self) -> None:
        """Emergency stop: latches until it is released. May come from any thread, and does not wait in a queue."""
        self.stopped, self.enabled, self._held = True, False, None
        self._pendant.worker.halt()

    def must_not_be_stopped(self) -> None:
        """Raises ActionRefusedError while the emergency stop is latched."""
        if self.stopped:
            raise ActionRefusedError(self._pendant.t("message.e_stop"))

    def _hold(self, jog: Jog, heard: float, press: int) -> None:
        pendant = self._pendant
        if time.monotonic() - heard > SILENCE:
            return
        self.must_not_be_stopped()
        if not self.enabled:
            pendant.say("warning", pendant.t("message.not_enabled"))
            return
        if self._held == jog and pendant.worker.running("jog"):
            return
        step = INCREMENTS[self.increment]
        if step and self._spent == (jog, press):
            return
        self._spent = (jog, press)
        pendant.worker.halt("move")
        self._held = jog
        pendant.worker.animate("jog", self._run(jog, step))

    def _run(self, jog: Jog, step: tuple[float, float] | None) -> Iterator[None]:
        """Tick by tick along one way; an increment is gone to its end, and held on, nothing more happens."""
        way = JogWay(self._pendant, jog)
        share, before = 0.0, time.monotonic()
        yield
        while self._wanted(jog) or (step and self._may(jog)):
            now = time.monotonic()
            passed, before = min(now - before, _LONGEST_TICK), now
            if share < 1.0:
                length, angle = (passed * self.override * speed for speed in (TIP_SPEED, TURN_SPEED))
                if step:
                    part = min(1.0 - share, max(length / step[0], angle / step[1]))
                    length, angle = part * step[0], part * step[1]
                    share += part
                if not way.go(length, angle, passed if step is None else None):
                    break
            elif not self._wanted(jog):
                break
            yield
        self._end(jog)

    def _may(self, jog: Jog) -> bool:
        return self._held == jog and self.enabled and not self.stopped

    def _wanted(self, jog: Jog) -> bool:
        return self._may(jog) and time.monotonic() - self._heard <= self._silence

    def _end(self, jog: Jog) -> None:
        if self._held == jog:
            self._held = None
        self._pendant.settle()
        self._pendant.post(self._pendant.page.numbers)  # as a job of its own: by then the motion is over
