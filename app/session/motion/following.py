"""The arm follows the drag handle by inverse kinematics, no faster than it may, and says why it stopped.

The handle is written back only when the drag ends: until then it is in the person's hand.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from app.geometry import Pose, exp_so3, log_so3
from app.session.motion.drive import Drive
from app.session.motion.guarding import words
from app.session.motion.pace import TIP_SPEED, TURN_SPEED, Pace

_FASTEST = 3.0  # times the joint speed, near a singular pose


class Following:
    """What a drag at the handle does.

    Args:
        drive: the arm's.
        ended: called on the worker when the handle was let go.
    """

    def __init__(self, drive: Drive, ended: Callable[[], None]):
        self._drive, self._ended = drive, ended
        self._target: Pose | None = None
        self._told = ""

    def event(self, phase: str, target: Pose) -> None:
        """From the scene, on any thread: only enqueues."""
        self._target = None if phase == "end" else target
        if phase == "end":
            self._drive.worker.post(self._end)
        else:
            self._drive.worker.latest("drag", self._begin)

    def _begin(self) -> None:
        drive = self._drive
        if self._target is None or drive.worker.running("drag"):
            return
        drive.must_not_be_stopped()
        drive.cancel()
        self._told = ""
        drive.worker.animate("drag", self._follow())
        if not drive.live:
            drive.voice.say("warning", drive.voice.t("message.not_enabled"))

    def _follow(self) -> Iterator[None]:
        pace = Pace(self._drive)
        while (target := self._target) is not None:
            passed = pace.passed()
            if passed > 0.0:
                self._towards(target, passed)
            yield

    def _towards(self, target: Pose, seconds: float) -> None:
        drive = self._drive
        found = drive.solve(_step(drive.hand(), target, seconds))
        most = _FASTEST * TURN_SPEED * seconds
        turned = float(np.abs(found.q - drive.q).max())
        q = found.q if turned <= most else drive.q + (found.q - drive.q) * (most / turned)
        stop = drive.advance(q)
        if stop is not None:
            why = words(stop, drive.voice.t, drive.voice.language)
        else:
            why = "" if found.reached else drive.why(found)
        if why != self._told:
            drive.voice.say("warning" if why else "info", why)
            self._told = why

    def _end(self) -> None:
        drive = self._drive
        drive.worker.halt("drag")
        self._told = ""
        self._ended()
        drive.rest()


def _step(now: Pose, target: Pose, seconds: float) -> Pose:
    """From where the tool is towards where it is wanted, as far as it may go in so many motion seconds."""
    way, turn = target.position - now.position, log_so3(target.rotation @ now.rotation.T)
    share = min(
        1.0,
        TIP_SPEED * seconds / max(float(np.linalg.norm(way)), 1e-12),
        TURN_SPEED * seconds / max(float(np.linalg.norm(turn)), 1e-12),
    )
    return Pose.of(exp_so3(share * turn) @ now.rotation, now.position + share * way)
