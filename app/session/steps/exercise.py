"""An exercise: begin, finish."""

from __future__ import annotations

import hashlib

import numpy as np

from app import resources
from app.calibration.base.wizard import BaseWizard, steps
from app.errors import UnknownNameError
from app.geometry import Pose
from app.session.actions import Begin, ChooseMode, Finish
from app.session.refusals import refusal
from app.session.state import Running, SessionState, Tool, first_state
from app.session.steps.setup import choose_mode

#: Where the exercises are; a session that began one nobody has cannot go on.
EXERCISES = [resources.STATIC / "exercises"]
#: What keys of exercises that were made here begin with.
MADE = "made_"
_DIGITS = 20  # hexadecimal, of the content's hash: 80 bits are not met by chance
_SKEW = 1e-6


def made_key(lesson: str) -> str:
    """The key of an exercise that was made here: another content is another exercise, and no journal confuses them."""
    return MADE + hashlib.sha256(lesson.encode()).hexdigest()[:_DIGITS]


def _pose(numbers: tuple[float, ...]) -> Pose:
    """A pose written row by row; raises ValueError where the numbers are none."""
    pose = Pose(np.reshape(numbers, (4, 4)))
    square = np.abs(pose.rotation.T @ pose.rotation - np.eye(3)).max()
    if not square < _SKEW or np.linalg.det(pose.rotation) < 0 or list(numbers[12:]) != [0.0, 0.0, 0.0, 1.0]:
        raise ValueError("a tool's numbers are no pose")
    return pose


def _begin(state: SessionState, action: Begin) -> SessionState:
    if state.running is not None:
        raise refusal("exercise_runs")
    try:
        fresh = first_state(action.robot)
        tools = tuple(Tool(name, _pose(numbers)) for name, numbers in action.tools)
    except (UnknownNameError, ValueError) as error:
        raise refusal("unknown", reason=str(error)) from None
    known = [path.stem for folder in EXERCISES for path in folder.glob("*.toml")]
    if action.lesson and made_key(action.lesson) != action.exercise:
        raise refusal("unknown", reason="the exercise's file is not the one it was begun with")
    if not action.lesson and action.exercise not in known:
        unknown = UnknownNameError(action.exercise[:80], available=known, what="exercise")
        raise refusal("unknown", reason=str(unknown))
    fresh = choose_mode(fresh, ChooseMode(action.mode, action.touches))
    wizard = BaseWizard(steps(2, action.tracker == "nests")) if action.tracker else None
    return fresh.but(tools=tools, running=Running(action, wizard=wizard), count=state.count)


def _finish(state: SessionState, action: Finish) -> SessionState:
    if state.running is None:
        raise refusal("no_exercise")
    return state.but(running=None)


ACTIONS = {Begin: _begin, Finish: _finish}
