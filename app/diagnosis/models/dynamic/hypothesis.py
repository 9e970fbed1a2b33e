"""A hypothesis about a whole log: how it was mounted and recorded. What it states is undone before laws are fitted."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from app.kinematics.robot import GRAVITY

if TYPE_CHECKING:
    from app.diagnosis.effects.dynamic._law import Law
    from app.diagnosis.effects.effect import Place
    from app.diagnosis.models.dynamic.samples import Samples


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """How the numbers of a log are to be read.

    Args:
        joints: n.
        gravity: (3,) [m/s^2] in base; zero where the torques are recorded without the part gravity makes.
        delay: the torque is recorded this much late [s].
        clock: true seconds per recorded second.
        order: column of the file that holds the torque of each joint.
        place_order: column of the file that holds the position of each joint.
        sense: (n,) 1 or -1, of the recorded torques.
        place_sense: (n,) 1 or -1, of the recorded positions.
        factor: (n,) recorded torque over true torque.
        place_factor: (n,) true position over recorded one: pi/180 where degrees stand under the name of radians.
    """

    joints: int
    gravity: np.ndarray
    delay: float = 0.0
    clock: float = 1.0
    order: tuple[int, ...] = ()
    place_order: tuple[int, ...] = ()
    sense: tuple[int, ...] = ()
    place_sense: tuple[int, ...] = ()
    factor: tuple[float, ...] = ()
    place_factor: tuple[float, ...] = ()

    @property
    def factors(self) -> np.ndarray:
        """(n,) recorded torque over true torque."""
        return np.array(self.factor) if self.factor else np.ones(self.joints)

    @property
    def moves(self) -> tuple:
        """What is read otherwise of the motion and of gravity: hypotheses with the same have the same rigid torques."""
        return (
            self.gravity.tobytes(), self.delay, self.clock, self.place_order, self.place_sense, self.place_factor,
        )  # fmt: skip

    @property
    def key(self) -> tuple:
        """The same for hypotheses that read a log alike."""
        return (*self.moves, self.order, self.sense, tuple(self.factors.tolist()))

    @property
    def tilt(self) -> float:
        """Angle between gravity and the description's [rad]; 0 where there is none at all."""
        size = float(np.linalg.norm(self.gravity))
        if size < 1e-9:
            return 0.0
        return float(np.arccos(np.clip(self.gravity @ GRAVITY / size / np.linalg.norm(GRAVITY), -1.0, 1.0)))

    def torque(self, y: np.ndarray) -> np.ndarray:
        """(m, n) recorded -> true torque of each joint."""
        if self.order:
            y = y[:, list(self.order)]
        if self.sense:
            y = y * np.array(self.sense)
        if self.factor:
            y = y / np.array(self.factor)
        return y

    def recorded(self, torque: np.ndarray) -> np.ndarray:
        """(m, n) true torque of each joint -> what the file would hold in its columns."""
        out = torque
        if self.factor:
            out = out * np.array(self.factor)
        if self.sense:
            out = out * np.array(self.sense)
        if self.order:
            out = out[:, np.argsort(self.order)]
        return out

    def motion(self, values: np.ndarray, derivative: int) -> np.ndarray:
        """(m, n) recorded position, speed or acceleration -> true."""
        if self.place_order:
            values = values[:, list(self.place_order)]
        if self.place_sense:
            values = values * np.array(self.place_sense)
        if self.place_factor:
            values = values * np.array(self.place_factor)
        return values / self.clock**derivative if self.clock != 1.0 else values


def as_given(joints: int) -> Hypothesis:
    """The log is what its header says, the arm stands as its description does."""
    return Hypothesis(joints, GRAVITY.copy())


class Read(Protocol):
    """A log under a hypothesis, with friction of each joint ready to be projected off."""

    samples: Samples

    def off(self, j: int, values: np.ndarray) -> np.ndarray: ...


@dataclass(frozen=True, eq=False)
class Trial:
    """A hypothesis that an effect offers to try before anything is fitted.

    Args:
        law: the effect that it undoes.
        place: of it, as reported.
        each: True where a number of every joint was fitted for it.
    """

    law: Law
    place: Place
    hypothesis: Hypothesis
    each: bool = False
