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

    def direction(self, joint: int, width: float | None = None) -> np.ndarray:
        """(M,) direction of motion of a joint (from 0), between -1 and 1: mean of tanh(speed / width)."""
        width = float(self.width[joint]) if width is None else width
        key = ("direction", joint, width)
        if key not in self.memory:
            self.memory[key] = np.tanh(self.fine[:, :, joint] / width).mean(axis=1)
        return self.memory[key]

    def wave(self, joint: int, order: float) -> np.ndarray:
        """(M, 2) sine and cosine of order times the joint's angle, averaged over the window."""
        angle = order * self.q[:, joint]
        fade = np.sinc(order * self.qd[:, joint] * self.window / (2 * np.pi))
        return np.stack([np.sin(angle) * fade, np.cos(angle) * fade], axis=1)

    def with_torque(self, torque: np.ndarray, drive: np.ndarray) -> State:
        """The same, the gears carrying `torque` (M, n), the drives giving `drive` (M, n)."""
        return replace(self, torque=torque, drive=drive)

    def with_width(self, width: np.ndarray) -> State:
        """The same, dry friction with sharpness `width` (n,)."""
        return replace(self, width=width)
