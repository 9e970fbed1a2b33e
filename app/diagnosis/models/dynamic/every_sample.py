"""A log sample by sample, for what windows would average away: worked out only where a law asks for it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.models.dynamic.hypothesis import Hypothesis
from app.diagnosis.models.dynamic.spline import hermite
from app.kinematics import RobotModel
from app.kinematics.regressor import torque_regressor

if TYPE_CHECKING:
    from app.diagnosis.models.dynamic.smoothing import Motion
    from app.diagnosis.observations.joint_log import Log


_AT_ONCE = 20_000  # samples whose regressor is in memory
_SLOW = 0.04  # s over which an inertia changes along a line
_TURNED = 0.1  # rad


@dataclass(frozen=True, eq=False)
class EverySample:
    """All samples of a log under a hypothesis.

    Args:
        hypothesis: how the log is read.
        nominal: (10 n,) the description's inertial parameters.
        first: (M,) first sample of each window of `window` samples.
    """

    log: Log
    robot: RobotModel
    motion: Motion
    hypothesis: Hypothesis
    nominal: np.ndarray
    first: np.ndarray
    window: int
    memory: dict = field(default_factory=dict, repr=False)

    @property
    def t(self) -> np.ndarray:
        """(m,) [s] from the start of the log."""
        return (self.log.t - self.log.t[0]) * self.hypothesis.clock

    @property
    def step(self) -> float:
        """Usual time between samples [s]."""
        return self.log.step * self.hypothesis.clock

    @property
    def runs(self) -> list[slice]:
        """Parts of the log without a gap."""
        return self.log.segments

    def both_sides(self, joint: int) -> bool:
        """True where the motor's angle of a joint (from 0) is recorded beside the link's."""
        motor = self.log.motor
        return motor is not None and bool(np.any(motor[:, joint] != self.log.q[:, joint]))

    def apart(self, joint: int) -> np.ndarray:
        """(m,) the motor's angle less the link's [rad], as the hypothesis reads positions."""
        assert self.log.motor is not None
        sides = (self.hypothesis.motion(values, 0)[:, joint] for values in (self.log.motor, self.log.q))
        return next(sides) - next(sides)

    def measured(self, joint: int) -> np.ndarray:
        """(m,) measured torque of a joint (from 0), as the hypothesis reads it [Nm]."""
        return self.hypothesis.torque(self.log.y)[:, joint]

    @property
    def rigid(self) -> np.ndarray:
        """(m, n) the description's torque [Nm]."""
        if "rigid" not in self.memory:
            parts = [
                np.arange(k, min(k + _AT_ONCE, len(self.log.t))) for k in range(0, len(self.log.t), _AT_ONCE)
            ]
            self.memory["rigid"] = np.concatenate([self._rigid(part) for part in parts])
        return self.memory["rigid"]

    def _rigid(self, part: np.ndarray) -> np.ndarray:
        q, qd, qdd = (v[:, 0] for v in self._motion(part[:, None]))
        return torque_regressor(self.robot, q, qd, qdd, gravity=self.hypothesis.gravity) @ self.nominal

    def inertia(self, joint: int, within: float = _SLOW) -> np.ndarray:
        """(M, n) torque of each joint [Nm] per acceleration of one (from 0) [rad/s^2], in the middle of each window.

        Args:
            within: time over which it is taken to change along a line [s].
        """

        def of(q: np.ndarray) -> np.ndarray:
            push, still = np.zeros_like(q), np.zeros_like(q)
            push[:, joint] = 1.0
            return torque_regressor(self.robot, q, still, push, gravity=np.zeros(3)) @ self.nominal

        return self._slowly(("inertia", joint, within), within, of)

    def weight(self, joint: int) -> np.ndarray:
        """(M, n) torque of each joint that gravity makes [Nm] per angle of one (from 0) [rad], likewise."""

        def of(q: np.ndarray) -> np.ndarray:
            still, less, more = np.zeros_like(q), q.copy(), q.copy()
            less[:, joint] -= _TURNED
            more[:, joint] += _TURNED
            ends = [
                torque_regressor(self.robot, at, still, still, gravity=self.hypothesis.gravity) @ self.nominal
                for at in (less, more)
            ]
            return (ends[1] - ends[0]) / (2.0 * np.sin(_TURNED))  # exact: gravity makes sines of an angle

        return self._slowly(("weight", joint), _SLOW, of)

    def _slowly(self, key: tuple, within: float, of: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
        """What changes with the pose alone, in the middle of each window; kept."""
        if key not in self.memory:
            centre = self.first + self.window // 2
            apart = self.step * float(centre[-1] - centre[0]) / max(len(centre) - 1, 1)  # s
            every = max(1, int(within / max(apart, self.step)))
            some = np.unique(np.append(np.arange(0, len(centre), every), len(centre) - 1))
            found = of(self._motion(centre[some][:, None])[0][:, 0])
            index = np.arange(len(centre))
            self.memory[key] = np.stack([np.interp(index, some, column) for column in found.T], axis=1)
        return self.memory[key]

    def _motion(self, index: np.ndarray) -> list[np.ndarray]:
        parts = moved(self.log, self.motion, index, self.hypothesis)
        shape = parts[0].shape
        return [
            self.hypothesis.motion(v.reshape(-1, shape[-1]), k).reshape(shape) for k, v in enumerate(parts)
        ]

    def pooled(self, values: np.ndarray) -> np.ndarray:
        """(m,) of samples -> (M,) means of windows."""
        return values if self.window == 1 and len(self.first) == len(values) else self._pooled(values)

    def _pooled(self, values: np.ndarray) -> np.ndarray:
        return values[self.first[:, None] + np.arange(self.window)].mean(axis=1)


def moved(
    log: Log, motion: Motion, index: np.ndarray, hypothesis: Hypothesis
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Recorded position, speed and acceleration (M, w, n) at the samples `index` (M, w), or as much earlier as torques
    are late, by cubics with the known slopes."""
    if not hypothesis.delay:
        return motion.q[index], motion.qd[index], motion.qdd[index]
    t = log.t
    first = np.array([s.start for s in log.segments])
    last = np.array([s.stop for s in log.segments]) - 1
    run = (np.searchsorted(first, index[:, 0], side="right") - 1)[:, None]  # across a gap nothing is known
    wanted = np.clip(t[index] - hypothesis.delay / hypothesis.clock, t[first][run], t[last][run])
    low = np.clip(np.searchsorted(t, wanted, side="right") - 1, 0, len(t) - 2)
    width = (t[low + 1] - t[low])[..., None]
    share = (wanted - t[low])[..., None] / width
    ends = low, low + 1
    parts = []
    for value, slope in ((motion.q, motion.qd), (motion.qd, motion.qdd), (motion.qdd, None)):
        rates = [_slope(motion.qdd, t, at) if slope is None else slope[at] for at in ends]
        parts.append(hermite(value[low], value[low + 1], rates[0] * width, rates[1] * width, share))
    return parts[0], parts[1], parts[2]


def _slope(values: np.ndarray, t: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Slope of values (m, n) over t (m,) at some samples, through the neighbours on either side."""
    before, after = np.maximum(at - 1, 0), np.minimum(at + 1, len(t) - 1)
    back, on = (t[at] - t[before])[..., None], (t[after] - t[at])[..., None]
    with np.errstate(divide="ignore", invalid="ignore"):
        left, right = (values[at] - values[before]) / back, (values[after] - values[at]) / on
    inner = (right * back + left * on) / (back + on)
    return np.where(back == 0.0, right, np.where(on == 0.0, left, inner))
