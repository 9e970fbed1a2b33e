"""The way of one jog: along an axis of a frame from where it began, so that it stays straight however long it lasts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from app.geometry import Pose, exp_so3
from app.kinematics.singular import singular_joints
from app.pendant.guarding import words
from app.pendant.user_frame import user_frame
from app.units import from_deg

if TYPE_CHECKING:
    from app.pendant.client import Pendant

FRAMES = ("joint", "base", "tool", "user")
_JOINT_FASTEST = from_deg(90.0)  # rad/s: a joint that would have to turn faster is near a singular pose
_JOINT_LARGEST = from_deg(20.0)  # rad: the same for one increment
_CRAWL = 0.05  # of the wanted speed: slower than this the arm stands


@dataclass(frozen=True)
class Jog:
    """One direction: frame, number of the axis from 0 (joints; or x, y, z and turns about them), sign."""

    frame: str
    axis: int
    sign: int


class JogWay:
    """From where the arm stands now, in one direction.

    Args:
        pendant: whose arm moves.
        jog: which way.
    """

    def __init__(self, pendant: Pendant, jog: Jog):
        self._pendant, self._jog = pendant, jog
        self._start, self._gone = pendant.hand(), 0.0
        if jog.frame != "joint":
            axes = {"base": np.eye(3), "tool": self._start.rotation, "user": user_frame(pendant).rotation}
            self._direction = jog.sign * axes[jog.frame][:, jog.axis % 3]

    def go(self, length: float, angle: float, seconds: float | None) -> bool:
        """A piece of the way; False, and said, where the arm cannot go on.

        Args:
            length: what the tool point moves, or a sliding joint [m].
            angle: what the tool turns, or a turning joint [rad].
            seconds: what the piece may take; None for an increment, which keeps to no speed.
        """
        pendant, joint = self._pendant, self._jog.frame == "joint"
        target, why = self._joint(length, angle, seconds) if joint else self._tool(length, angle, seconds)
        if not why:
            stop = pendant.advance(target)
            why = "" if stop is None else words(stop, pendant.t, pendant.language)
        if why:
            pendant.say("warning", why)
        return not why

    def _joint(self, length: float, angle: float, seconds: float | None) -> tuple[np.ndarray, str]:
        pendant, k = self._pendant, self._jog.axis
        model, q = pendant.model, pendant.q.copy()
        wanted = q[k] + self._jog.sign * (length if model.joints[k].prismatic else angle)
        q[k] = np.clip(wanted, model.lower[k], model.upper[k])
        moved = float(np.linalg.norm(pendant.hand(q).position - pendant.hand().position))
        if seconds is not None and moved > length > 0.0:  # a long arm: the tip keeps to the manual speed
            q[k] = pendant.q[k] + (q[k] - pendant.q[k]) * length / moved
        if q[k] == pendant.q[k]:
            return q, pendant.t("message.limit", joints=str(k + 1))
        return q, ""

    def _tool(self, length: float, angle: float, seconds: float | None) -> tuple[np.ndarray, str]:
        pendant = self._pendant
        piece = length if self._jog.axis < 3 else angle
        found = pendant.solve(self._aim(self._gone + piece))
        if not found.reached:
            return found.q, pendant.why(found)
        most = _JOINT_LARGEST if seconds is None else _JOINT_FASTEST * seconds
        turned = float(np.abs(found.q - pendant.q).max())
        if turned > most:  # near a singular pose joints race: the tool waits for them
            share = most / turned
            found = pendant.solve(self._aim(self._gone + share * piece))
            raced = float(np.abs(found.q - pendant.q).max()) > 2.0 * most
            if share < _CRAWL or raced or not found.reached:
                joints = ", ".join(map(str, singular_joints(pendant.model, pendant.q)))
                return found.q, pendant.t("message.singular", joints=joints)
            piece *= share
        self._gone += piece
        return found.q, ""

    def _aim(self, gone: float) -> Pose:
        start = self._start
        if self._jog.axis < 3:
            return Pose.of(start.rotation, start.position + gone * self._direction)
        return Pose.of(exp_so3(gone * self._direction) @ start.rotation, start.position)
