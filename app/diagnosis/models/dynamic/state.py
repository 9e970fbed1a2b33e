"""What torque laws are written in: windows of a joint log, the description's torques and what is linear in them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.models.dynamic.hypothesis import Hypothesis

if TYPE_CHECKING:
    from app.diagnosis.models.dynamic.every_sample import EverySample


@dataclass(frozen=True, eq=False)
class State:
    """M windows of a joint log; SI units.

    Args:
        hypothesis: how the log is read.
        t: (M,) [s] from the start of the log, the middle of each window.
        q, qd, qdd: (M, n) means over the window.
        fine: (M, w, n) speed of every sample of the window: the direction of friction is averaged.
        regressor: (M, n, 10 n) d torque / d inertial parameters.
        torque: (M, n) rigid torque that the gears carry [Nm or N]; the description's until loads and masses are added.
        drive: (M, n) torque that the drives give: what the gears carry, and friction, as far as known [Nm or N].
        levers: gives d torque / d gravity (M, n, 3) and d torque / d wrench at the flange (M, n, 6); see below.
        payload_columns: (M, n, 10) d torque / d inertial parameters of a body in the flange frame.
        temperature, commanded: (M, n) or None.
        speed: (n,) a usual speed of each joint: 90% quantile of |qd|.
        seconds: length of the log.
        window: seconds that one window lasts.
        sliding: (n,) True for prismatic joints.
        width: (n,) [rad/s or m/s] speed at which dry friction has reached 76% of its level.
        slip: (n,) [rad or m] way after a turn on which it has come to 63% of the other level; 0 where it turns at once.
        still: (n,) [rad/s or m/s] speed that cannot be told from standstill.
        size: (n,) root mean square of the torque, what is small or large on this joint [Nm or N].
        link_mass: (n,) [kg] and link_size: (n,) [m] of the description: what is small or large for a link.
        every: the log sample by sample, or None where there is none.
    """

    hypothesis: Hypothesis
    t: np.ndarray
    q: np.ndarray
    qd: np.ndarray
    qdd: np.ndarray
    fine: np.ndarray
    regressor: np.ndarray
    torque: np.ndarray
    drive: np.ndarray
    levers: Callable[[], tuple[np.ndarray, np.ndarray]]
    payload_columns: np.ndarray
    temperature: np.ndarray | None
    commanded: np.ndarray | None
    speed: np.ndarray
    seconds: float
    window: float
    sliding: np.ndarray
    width: np.ndarray
    slip: np.ndarray
    still: np.ndarray
    size: np.ndarray
    link_mass: np.ndarray
    link_size: np.ndarray
    every: EverySample | None = None
    memory: dict = field(default_factory=dict, repr=False)

    @property
    def joints(self) -> int:
        return self.q.shape[1]

    @property
    def gravity_columns(self) -> np.ndarray:
        """(M, n, 3) d torque / d gravity vector."""
        return self._levers()[0]

    @property
    def wrench_columns(self) -> np.ndarray:
        """(M, n, 6) d torque / d force with which the flange pushes on the world, and moment with which it turns it."""
        return self._levers()[1]

    @property
    def gravity_torque(self) -> np.ndarray:
        """(M, n) the description's part that gravity makes."""
        return self.gravity_columns @ self.hypothesis.gravity

    def _levers(self) -> tuple[np.ndarray, np.ndarray]:
        if "levers" not in self.memory:  # most readings of a log are tried without
            self.memory["levers"] = self.levers()
        return self.memory["levers"]

    def moves(self, joint: int) -> bool:
        """True where joint (from 0) moves enough to have friction."""
        return bool(self.speed[joint] > 1e-3)

    def stands(self, joint: int) -> np.ndarray:
        """(M,) True where joint (from 0) cannot be told from standing still."""
        return np.abs(self.qd[:, joint]) < self.still[joint]

    def direction(self, joint: int, width: float | None = None, slip: float | None = None) -> np.ndarray:
        """(M,) direction of dry friction of a joint (from 0), between -1 and 1, see `turned`.

        Args:
            width, slip: the joint's own unless given.
        """
        width = float(self.width[joint]) if width is None else width
        slip = float(self.slip[joint]) if slip is None else slip
        key = ("direction", joint, width, slip)
        if key not in self.memory:
            self.memory[key] = turned(self.fine[:, :, joint], self.q[:, joint], width, slip)
        return self.memory[key]

    def wave(self, joint: int, order: float) -> np.ndarray:
        """(M, 2) sine and cosine of order times the joint's angle, averaged over the window."""
        angle = order * self.q[:, joint]
        fade = np.sinc(order * self.qd[:, joint] * self.window / (2 * np.pi))
        return np.stack([np.sin(angle) * fade, np.cos(angle) * fade], axis=1)

    def with_torque(self, torque: np.ndarray, drive: np.ndarray) -> State:
        """The same, the gears carrying `torque` (M, n), the drives giving `drive` (M, n)."""
        return replace(self, torque=torque, drive=drive)

    def with_turn(self, width: np.ndarray, slip: np.ndarray) -> State:
        """The same, dry friction turning over speeds `width` (n,) or ways `slip` (n,)."""
        return replace(self, width=width, slip=slip)


def turned(fine: np.ndarray, q: np.ndarray, width: float, slip: float) -> np.ndarray:
    """(M,) direction of dry friction: mean of tanh(speed / width), or, where `slip` is above 0, what follows the way.

    After a turn the teeth and bearings of a gear give way elastically before they slide: dz/dq = (sign(qd) - z) / slip.
    At rest z stays what the motion before has left.

    Args:
        fine: (M, w) speed of every sample of a window; q: (M,) position.
        width, slip: see State.

    Source: Dahl (1968), A solid friction model, with exponent 1; Canudas de Wit et al. (1995), A new model for control
    of systems with friction, IEEE Transactions on Automatic Control 40(3), at low speed.
    """
    sharp = np.tanh(fine / width).mean(axis=1)
    if slip <= 0.0:
        return sharp
    way = np.diff(q)
    towards = np.sign(way).tolist()
    stays = np.exp(-np.abs(way) / slip).tolist()
    out, z = [float(sharp[0])], float(sharp[0])
    for s, a in zip(towards, stays, strict=True):
        z = s + a * (z - s)
        out.append(z)
    return np.array(out)
