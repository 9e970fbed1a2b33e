"""What torque laws are written in: the motion, and the torques the description predicts for it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np


@dataclass(frozen=True, eq=False)
class State:
    """Samples of a motion; SI units.

    Args:
        t: (m,) [s], from the start of the log.
        q, qd, qdd: (m, n).
        torque: (m, n) what the description predicts [Nm or N].
        torque_rate: (m, n) its slope in time [Nm/s].
        gravity_torque: (m, n) its part that gravity makes.
        gravity_columns: (m, n, 3) d torque / d gravity vector.
        force_columns: (m, n, 3) d torque / d force with which the flange pushes on the world.
        payload_columns: (m, n, 10) d torque / d inertial parameters of a body in the flange frame.
        temperature: (m, n) [degC], or None.
        speed: (n,) a usual speed of each joint: 90% quantile of |qd|.
        seconds: length of the log.
        sliding: (n,) True for prismatic joints.
    """

    t: np.ndarray
    q: np.ndarray
    qd: np.ndarray
    qdd: np.ndarray
    torque: np.ndarray
    torque_rate: np.ndarray
    gravity_torque: np.ndarray
    gravity_columns: np.ndarray
    force_columns: np.ndarray
    payload_columns: np.ndarray
    temperature: np.ndarray | None
    speed: np.ndarray
    seconds: float
    sliding: np.ndarray

    @property
    def joints(self) -> int:
        return self.q.shape[1]

    def turned(self, joint: int, times: int) -> np.ndarray:
        """(m,) exp(1j times q) of a joint (from 0), by halves: its powers of two are kept."""
        key = (joint, times)
        if key in self._powers:
            return self._powers[key]
        if times == 1:
            q = self.q[:, joint]
            out = np.empty(len(q), complex)
            out.real, out.imag = np.cos(q), np.sin(q)
        else:
            low = 1 << (times.bit_length() - 1)
            low = low // 2 if low == times else low
            out = self.turned(joint, low) * self.turned(joint, times - low)
        if times & (times - 1) == 0:
            self._powers[key] = out
        return out

    @cached_property
    def _powers(self) -> dict[tuple[int, int], np.ndarray]:
        return {}

    def moves(self, joint: int) -> bool:
        """True where joint (from 0) moves enough to have friction."""
        return bool(self.speed[joint] > 1e-3)

    def at(self, index: np.ndarray) -> State:
        """Some of the samples."""
        per_sample = {
            name: value[index]
            for name in self.__dataclass_fields__
            if isinstance(value := getattr(self, name), np.ndarray) and name not in ("speed", "sliding")
        }
        return replace(self, **per_sample)
