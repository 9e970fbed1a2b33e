"""How long a way takes at 100%, and how much of that time has passed: none while the switch is not held."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Protocol

import numpy as np

from app.geometry import Pose
from app.kinematics import RobotModel
from app.units import from_deg, from_mm

TIP_SPEED = from_mm(250.0)  # T1's manual speed at the tool point [m/s], ISO 10218-1
TURN_SPEED = from_deg(30.0)  # rad/s of a joint, and about the tool point, at 100%
LONGEST_TICK = 0.1  # seconds: a machine that stuttered does not leap
_LOOKS = 24  # places on a way at which its speed is looked at, at most
_LOOK = 0.1  # rad or m that a joint goes between two looks: the chord is .04% shorter than the arc


class Paced(Protocol):
    """What a pace needs of an arm's drive."""

    override: float
    clock: Callable[[], float]

    @property
    def live(self) -> bool:
        """True while the arm may move."""
        ...


class Measured(Protocol):
    """What measures without moving."""

    measuring: bool


class Pace:
    """Motion time: real seconds times the override, and none while the arm may not move.

    Args:
        drive: whose switch and override count.
    """

    def __init__(self, drive: Paced):
        self._drive, self._before = drive, drive.clock()

    def passed(self) -> float:
        """Motion seconds since this was last asked."""
        now = self._drive.clock()
        passed, self._before = min(now - self._before, LONGEST_TICK), now
        return passed * self._drive.override if self._drive.live else 0.0


def duration(robot: RobotModel, start: np.ndarray, end: np.ndarray, points: np.ndarray) -> float:
    """Seconds at 100% for the straight joint way from start to end (n,), so that no speed is exceeded on it.

    Args:
        points: (k, 3) in the flange [m]: tool points that keep to the manual speed.
    """
    limits = np.where(robot.chain.prismatic, TIP_SPEED, TURN_SPEED)
    slowest = float((np.abs(end - start) / limits).max(initial=0.0))
    return max(slowest, tip_seconds(robot, start, end, points))


def tip_seconds(robot: RobotModel, start: np.ndarray, end: np.ndarray, points: np.ndarray) -> float:
    """The same for the points alone, whatever the joints do."""
    furthest = float(np.abs(end - start).max(initial=0.0))
    # A tick of a jog needs no more than its two ends.
    looks = min(_LOOKS, max(1, math.ceil(furthest / _LOOK)))
    flanges = np.array([robot.flange_matrix(start + (end - start) * (k / looks)) for k in range(looks + 1)])
    places = flanges[:, None, :3, 3] + points @ flanges[:, :3, :3].transpose(0, 2, 1)
    fastest = float(np.linalg.norm(np.diff(places, axis=0), axis=2).max(initial=0.0)) * looks
    return fastest / TIP_SPEED


def travel(
    drive: Paced, start: np.ndarray, end: np.ndarray, seconds: float, show: Callable[[np.ndarray], object]
) -> Iterator[None]:
    """From start to end (n,) in so many motion seconds; `show` is called with each pose, the last is exactly `end`.

    Where `show` gives something back the way ends there.
    """
    pace, gone = Pace(drive), 0.0
    if seconds > 0.0:
        yield
    while gone < seconds:
        passed = pace.passed()
        if passed > 0.0:
            gone += passed
            if show(start + (end - start) * min(gone / seconds, 1.0)) is not None:
                return
        if gone < seconds:
            yield
    while not drive.live and seconds > 0.0:  # let go of at the very end: the last step is one, too
        yield
    show(end)


def pause(drive: Paced, seconds: float) -> Iterator[None]:
    """Nothing, for a while: real seconds, and no less than that."""
    end = drive.clock() + seconds
    while drive.clock() < end:
        yield


@contextmanager
def measuring(drive: Measured) -> Iterator[None]:
    """What runs within looks at what stands: no arm moves, and it needs no switch."""
    drive.measuring = True
    try:
        yield
    finally:
        drive.measuring = False


def tool_points(T_flange_tool: Pose, drawn: Pose) -> np.ndarray:
    """(3, 3) points that keep to the manual speed: the flange, the active tool's point, the tip that is drawn."""
    return np.array([np.zeros(3), T_flange_tool.position, drawn.position])
