"""The state of one session: frozen, and everything a screen needs to draw itself."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from types import MappingProxyType
from typing import Any

import numpy as np

from app import catalog
from app.calibration.base.wizard import BaseWizard
from app.calibration.captures import Capture, Mode, Step
from app.calibration.solving import Solved
from app.diagnosis.model import SavedModel
from app.errors import UnknownNameError
from app.geometry import Pose
from app.kinematics import RobotModel, load_robot, robot_names
from app.session.actions import Begin, Enter, LoadPoints, OpenCell, Weighed

MODES = "app.calibration.modes"
FIRST_ROBOT = "jby50"
FIRST_MODE = "touch_zx"
#: The mode in which numbers are typed instead of points recorded.
DIRECT = "direct"


@dataclass(frozen=True)
class Tool:
    """A tool frame that was accepted, under its name."""

    name: str
    T_flange_tool: Pose


@dataclass(frozen=True, eq=False)
class Running:
    """An exercise that is being done.

    Args:
        begun: how it began.
        records: points recorded so far, those recorded again counted again; Undo does not take one back.
        wizard: the two-robot procedure, where that is the exercise.
    """

    begun: Begin
    records: int = 0
    wizard: BaseWizard | None = None


@dataclass(frozen=True, eq=False)
class TwoRobots:
    """A cell of two robots in which somebody works through the procedure.

    Args:
        opened: how it was set up.
        wizard: where the procedure stands, with everything measured.
    """

    opened: OpenCell
    wizard: BaseWizard


@dataclass(frozen=True, eq=False)
class Weighing:
    """The lesson of load data: what hangs there and how far it was weighed.

    Args:
        seed: draws the load.
        poses: joint positions of the run's poses by their number, from 0.
        found: what the run through all of them gave; None before it, and as soon as a pose changes.
    """

    seed: int
    poses: Mapping[int, tuple[float, ...]] = field(default_factory=dict)
    found: Weighed | None = None

    def __post_init__(self):
        object.__setattr__(self, "poses", MappingProxyType(dict(self.poses)))


@dataclass(frozen=True, eq=False)
class SessionState:
    """One moment of a session.

    Args:
        robot: name of the arm.
        q: (n,) where it stands [rad or m].
        mode: key of the wizard mode.
        touches: how many touches its list has.
        method: estimator of the tool point.
        captures: recorded points by step.
        comments: notes by step.
        result: what Calculate gave, with its quality; None as soon as a point changes.
        tools: accepted tools, the last one is active.
        source: the file the points came from; None where they were recorded here.
        entered: the tool frame typed in for the mode `direct`.
        running: the exercise that is being done.
        two_robots: the cell of two robots that is open.
        load: the load that is being weighed.
        user_frame: T_base_user that was typed or taught; None where it is the table's.
        cell_model: what is wrong with the arm in the practice cell; None where it is as described.
        count: actions so far.
        before: what Undo goes back to.
        after: what Redo goes forward to.
    """

    robot: str
    q: tuple[float, ...]
    mode: str
    touches: int
    method: str = "joint"
    captures: Mapping[str, Capture] = field(default_factory=dict)
    comments: Mapping[str, str] = field(default_factory=dict)
    result: Solved | None = None
    tools: tuple[Tool, ...] = ()
    source: LoadPoints | None = None
    entered: Enter | None = None
    running: Running | None = None
    two_robots: TwoRobots | None = None
    load: Weighing | None = None
    user_frame: Pose | None = None
    cell_model: SavedModel | None = None
    count: int = 0
    before: SessionState | None = field(default=None, repr=False)
    after: SessionState | None = field(default=None, repr=False)

    def __post_init__(self):
        object.__setattr__(self, "captures", MappingProxyType(dict(self.captures)))
        object.__setattr__(self, "comments", MappingProxyType(dict(self.comments)))

    @property
    def model(self) -> RobotModel:
        return robot_named(self.robot)

    @property
    def steps(self) -> tuple[Step, ...]:
        """The wizard's rows."""
        return _rows(self.mode, self.touches)

    @property
    def missing(self) -> tuple[Step, ...]:
        """Rows without a recorded point, in order."""
        return tuple(step for step in self.steps if step.key not in self.captures)

    @property
    def tool(self) -> Tool | None:
        """The active tool; None while only the bare flange is known."""
        return self.tools[-1] if self.tools else None

    @property
    def ordered(self) -> tuple[Capture, ...]:
        """Recorded points in the order of the wizard's rows."""
        return tuple(self.captures[s.key] for s in self.steps if s.key in self.captures)

    def step(self, key: str) -> Step | None:
        return next((s for s in self.steps if s.key == key), None)

    def but(self, **changes: Any) -> SessionState:
        """The same state with these fields changed.

        Raises:
            TypeError: a state has no such field.
        """
        # A session is opened by doing all of its actions again: `dataclasses.replace` would be half of that.
        if not changes.keys() <= self.__dict__.keys():
            raise TypeError(f"a state has no {', '.join(changes.keys() - self.__dict__.keys())}")
        other = object.__new__(SessionState)
        other.__dict__.update(self.__dict__, **changes)
        if "captures" in changes or "comments" in changes:
            other.__post_init__()
        return other


def accepted(state: SessionState) -> bool:
    """True where the result that is shown is the active tool."""
    return (
        state.result is not None
        and state.tool is not None
        and state.tool.T_flange_tool is state.result.result.T_flange_tool
    )


#: Arms besides the shipped ones that sessions of this process may use: name -> what reads it.
_GRANTED: dict[str, Callable[[str], RobotModel]] = {}


def grant_robot(name: str, read: Callable[[str], RobotModel] = load_robot) -> None:
    """Sessions of this process may use this arm: a person named or brought it, no file did.

    Args:
        name: what sessions call it.
        read: gives the arm of that name.
    """
    _GRANTED[name] = read


def known_robot(name: str) -> bool:
    """True for a shipped arm and one that was granted."""
    return name in _GRANTED or name in robot_names()


@lru_cache(maxsize=64)
def robot_named(name: str) -> RobotModel:
    """A shipped arm, or one that was granted, read once. A session is data: what it names is not opened for that.

    Raises:
        UnknownNameError: neither of them.
    """
    shipped = robot_names()
    if name in shipped:
        return load_robot(name)
    if name not in _GRANTED:
        raise UnknownNameError(name[:80], available=shipped, what="robot")
    return _GRANTED[name](name)


def mode_named(key: str) -> Mode:
    """A wizard mode; raises UnknownNameError."""
    return catalog.member(MODES, "MODE", key, what="wizard mode")


@lru_cache(maxsize=256)
def _rows(mode: str, touches: int) -> tuple[Step, ...]:
    """A mode's steps, made once: the read-out asks for them ten times a second."""
    return mode_named(mode).steps(touches)


def first_state(robot: str | None = None, mode: str = FIRST_MODE) -> SessionState:
    """Where every session starts: the arm at home, the position + Z/X wizard, nothing recorded."""
    names = robot_names()
    chosen = robot or (FIRST_ROBOT if FIRST_ROBOT in names or not names else names[0])
    model = robot_named(chosen)
    return SessionState(chosen, as_tuple(model.home), mode, mode_named(mode).default_touches)


def as_tuple(q: np.ndarray) -> tuple[float, ...]:
    """Joint positions as plain numbers."""
    return tuple(float(v) for v in q)
