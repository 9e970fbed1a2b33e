"""The way of one jog: along an axis of a frame from where it began, so that it stays straight however long it lasts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.geometry import Pose, exp_so3
from app.kinematics.singular import singular_joints
from app.session.motion.drive import Drive
from app.session.motion.guarding import words
from app.session.motion.pace import TIP_SPEED, TURN_SPEED, duration, tip_seconds
from app.session.motion.user_frame import user_frame

FRAMES = ("joint", "base", "tool", "user")
_FASTEST = 3.0  # times the joint speed: a joint that would have to turn faster is near a singular pose
_CRAWL = 0.05  # of the wanted speed: slower than this the arm stands


@dataclass(frozen=True)
class Jog:
    """One direction: frame, number of the axis from 0 (joints; or x, y, z and turns about them), sign."""

    frame: str
    axis: int
    sign: int


@dataclass(frozen=True)
class Part:
    """A piece of the way.

    Args:
        size: [m] or [rad], whichever the jog is about.
        seconds: motion seconds it takes; an increment's last piece may take less than a tick.
    """

    size: float
    seconds: float


class JogWay:
    """From where the arm stands now, in one direction.

    Args:
        drive: the arm's.
        jog: which way.
    """

    def __init__(self, drive: Drive, jog: Jog):
        self._drive, self._jog = drive, jog
        self._start, self._gone = drive.hand(), 0.0
        if jog.frame != "joint":
            user = user_frame(drive.session.state, drive.world)
            axes = {"base": np.eye(3), "tool": self._start.rotation, "user": user.rotation}
            self._direction = jog.sign * axes[jog.frame][:, jog.axis % 3]

    @property
    def _slides(self) -> bool:
        """Whether the jog is about a length, not about an angle."""
        if self._jog.frame == "joint":
            return self._drive.model.joints[self._jog.axis].prismatic
        return self._jog.axis < 3

    def whole(self, step: tuple[float, float]) -> float:
        """Size of an increment [m] or [rad]."""
        return step[0] if self._slides else step[1]

    def part(self, seconds: float, step: tuple[float, float] | None, left: float) -> Part:
        """What is gone in so many motion seconds, at most `left` of the increment."""
        size = seconds * (TIP_SPEED if self._slides else TURN_SPEED)
        if step is not None:
            size = min(size, left * self.whole(step))
        return Part(size, seconds)

    def go(self, part: Part) -> float | None:
        """A piece of the way; how much of its size was gone, or None, and said, where the arm cannot go on."""
        drive, joint = self._drive, self._jog.frame == "joint"
        target, size, why = self._joint(part) if joint else self._tool(part)
        if not why:
            stop = drive.advance(target)
            why = "" if stop is None else words(stop, drive.voice.t, drive.voice.language)
        if why:
            drive.voice.say("warning", why)
            return None
        self._gone += size
        return size

    def _joint(self, part: Part) -> tuple[np.ndarray, float, str]:
        drive, k, size = self._drive, self._jog.axis, part.size
        model, q = drive.model, drive.q.copy()
        q[k] = np.clip(q[k] + self._jog.sign * size, model.lower[k], model.upper[k])
        if q[k] == drive.q[k]:
            return q, 0.0, drive.voice.t("message.limit", joints=str(k + 1))
        needed = duration(model, drive.q, q, drive.points)
        if needed > part.seconds:  # a long arm: the tip keeps to the manual speed
            size *= part.seconds / needed
            q[k] = drive.q[k] + (q[k] - drive.q[k]) * part.seconds / needed
        return q, size, ""

    def _tool(self, part: Part) -> tuple[np.ndarray, float, str]:
        drive, size = self._drive, part.size
        found = drive.solve(self._aim(self._gone + size))
        if not found.reached:
            return found.q, 0.0, drive.why(found)
        most = _FASTEST * TURN_SPEED * part.seconds
        turned = float(np.abs(found.q - drive.q).max())
        # A shift moves every point alike; in a turn those far from the tool point swing.
        needed = 0.0 if self._slides else tip_seconds(drive.model, drive.q, found.q, drive.points)
        share = min(1.0, most / max(turned, 1e-12), part.seconds / max(needed, 1e-12))
        if share < 1.0:  # near a singular pose joints race: the tool waits for them
            found = drive.solve(self._aim(self._gone + share * size))
            raced = float(np.abs(found.q - drive.q).max()) > 2.0 * most
            if share < _CRAWL or raced or not found.reached:
                joints = ", ".join(map(str, singular_joints(drive.model, drive.q)))
                return found.q, 0.0, drive.voice.t("message.singular", joints=joints)
            size *= share
        return found.q, size, ""

    def _aim(self, gone: float) -> Pose:
        start = self._start
        if self._jog.axis < 3:
            return Pose.of(start.rotation, start.position + gone * self._direction)
        return Pose.of(exp_so3(gone * self._direction) @ start.rotation, start.position)
