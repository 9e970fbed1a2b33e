"""Hold-to-move: velocity integrated on the server by the clock, with an enabling switch that times out.

A browser only says "still held". When it falls silent for `SILENCE` the arm stands, whatever the browser believes.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from app.errors import ActionRefusedError
from app.geometry import Pose, exp_so3
from app.units import from_deg, from_mm

if TYPE_CHECKING:
    from app.pendant.client import Pendant

SILENCE = 0.3  # seconds without a word from the browser after which the arm stands
TIP_SPEED = from_mm(250.0)  # manual speed at the tool point, m/s
JOINT_SPEED = from_deg(30.0)  # rad/s at 100%
TURN_SPEED = from_deg(30.0)  # rad/s about the tool point at 100%
_LONGEST_TICK = 0.1  # seconds: a machine that stuttered does not leap

#: Increment -> length [m] and angle [rad]; None moves as long as the button is held.
INCREMENTS: dict[str, tuple[float, float] | None] = {
    "continuous": None,
    "large": (from_mm(10.0), from_deg(3.0)),
    "medium": (from_mm(1.0), from_deg(1.0)),
    "small": (from_mm(0.1), from_deg(0.1)),
}
FRAMES = ("joint", "base", "tool")


@dataclass(frozen=True)
class Jog:
    """One direction: frame, number of the axis from 0 (joints; or x, y, z and turns about them), sign."""

    frame: str
    axis: int
    sign: int


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
        self._heard = 0.0

    def hear(self, jog: Jog) -> None:
        """The button is (still) held; from the event loop: takes the time and enqueues."""
        heard = time.monotonic()
        self._heard = heard
        self._pendant.worker.latest("jog", lambda: self._hold(jog, heard))

    def stop(self) -> None:
        """Emergency stop: latches until it is released. May come from any thread, and does not wait in a queue."""
        self.stopped, self.enabled, self._held = True, False, None
        self._pendant.worker.halt()

    def must_not_be_stopped(self) -> None:
        """Raises ActionRefusedError while the emergency stop is latched."""
        if self.stopped:
            raise ActionRefusedError(self._pendant.t("message.e_stop"))

    def _hold(self, jog: Jog, heard: float) -> None:
        pendant = self._pendant
        if time.monotonic() - heard > SILENCE:
            return
        self.must_not_be_stopped()
        if not self.enabled:
            pendant.say("warning", pendant.t("message.not_enabled"))
            return
        step = INCREMENTS[self.increment]
        fresh = self._held != jog or not pendant.worker.running("jog")
        self._held = jog
        if step is None:
            if fresh:
                pendant.worker.animate("jog", self._run(jog))
        elif fresh:  # one press, one increment: held on, nothing more happens
            self._by(jog, *step)
            pendant.worker.animate("jog", self._wait(jog))

    def _wait(self, jog: Jog) -> Iterator[None]:
        while self._wanted(jog):
            yield
        self._end()

    def _run(self, jog: Jog) -> Iterator[None]:
        before = time.monotonic()
        yield
        while self._wanted(jog):
            now = time.monotonic()
            passed, before = min(now - before, _LONGEST_TICK), now
            length = passed * self.override * TIP_SPEED
            angle = passed * self.override * (JOINT_SPEED if jog.frame == "joint" else TURN_SPEED)
            if not self._by(jog, length, angle):
                break
            yield
        self._end()

    def _wanted(self, jog: Jog) -> bool:
        silent = time.monotonic() - self._heard > SILENCE
        return self._held == jog and self.enabled and not self.stopped and not silent

    def _end(self) -> None:
        self._held = None
        self._pendant.settle()
        self._pendant.page.numbers()

    def _by(self, jog: Jog, length: float, angle: float) -> bool:
        """One step; False, and said, where the arm cannot go on."""
        pendant = self._pendant
        if jog.frame == "joint":
            target, why = self._joint(jog, length, angle)
        else:
            target, why = self._cartesian(jog, length, angle)
        if why:
            pendant.say("warning", why)
            return False
        pendant.show(target)
        return True

    def _joint(self, jog: Jog, length: float, angle: float) -> tuple[np.ndarray, str]:
        pendant = self._pendant
        model, q = pendant.model, pendant.q.copy()
        wanted = q[jog.axis] + jog.sign * (length if model.joints[jog.axis].prismatic else angle)
        q[jog.axis] = np.clip(wanted, model.lower[jog.axis], model.upper[jog.axis])
        moved = float(np.linalg.norm(pendant.world.hand(q).position - pendant.world.hand(pendant.q).position))
        most = length if self.increment == "continuous" else np.inf
        if moved > most > 0.0:  # a long arm: the tip keeps to the manual speed
            q[jog.axis] = pendant.q[jog.axis] + (q[jog.axis] - pendant.q[jog.axis]) * most / moved
        if q[jog.axis] == pendant.q[jog.axis]:
            return q, pendant.t("message.limit", joints=str(jog.axis + 1))
        return q, ""

    def _cartesian(self, jog: Jog, length: float, angle: float) -> tuple[np.ndarray, str]:
        pendant = self._pendant
        tip = pendant.world.hand(pendant.q)
        axes = tip.rotation if jog.frame == "tool" else np.eye(3)
        direction = jog.sign * axes[:, jog.axis % 3]
        if jog.axis < 3:
            aim = Pose.of(tip.rotation, tip.position + length * direction)
        else:
            aim = Pose.of(exp_so3(angle * direction) @ tip.rotation, tip.position)
        found = pendant.solve(aim)
        return found.q, "" if found.reached else pendant.why(found)
