"""An exercise: begin, finish."""

from __future__ import annotations

import numpy as np

from app.calibration.base.wizard import BaseWizard, steps
from app.errors import UnknownNameError
from app.geometry import Pose
from app.session.actions import Begin, ChooseMode, Finish
from app.session.refusals import refusal
from app.session.state import Running, SessionState, Tool, first_state
from app.session.steps.setup import choose_mode


def _begin(state: SessionState, action: Begin) -> SessionState:
    if state.running is not None:
        raise refusal("exercise_runs")
    try:
        fresh = first_state(action.robot)
        tools = tuple(Tool(name, Pose(np.reshape(numbers, (4, 4)))) for name, numbers in action.tools)
    except (UnknownNameError, ValueError) as error:
        raise refusal("unknown", reason=str(error)) from None
    fresh = choose_mode(fresh, ChooseMode(action.mode, action.touches))
    wizard = BaseWizard(steps(2, action.tracker == "nests")) if action.tracker else None
    return fresh.but(tools=tools, running=Running(action, wizard=wizard), count=state.count)


def _finish(state: SessionState, action: Finish) -> SessionState:
    if state.running is None:
        raise refusal("no_exercise")
    return state.but(running=None)


ACTIONS = {Begin: _begin, Finish: _finish}
