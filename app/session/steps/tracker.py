"""Two robots and a laser tracker: the cell, and what is measured in it, in an exercise or freely."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from app.calibration.base.wizard import BaseWizard, steps
from app.errors import UnknownNameError
from app.session.actions import CloseCell, OpenCell, Tracked, TrackerNext, TrackerUndo
from app.session.refusals import refusal
from app.session.state import SessionState, TwoRobots, robot_named


def _open(state: SessionState, action: OpenCell) -> SessionState:
    if state.running is not None:
        raise refusal("exercise_runs")
    try:
        for name in (action.first, action.second):
            robot_named(name)
    except UnknownNameError as error:
        raise refusal("unknown", reason=str(error)) from None
    return state.but(two_robots=TwoRobots(action, BaseWizard(steps(2, action.nests))))


def _close(state: SessionState, action: CloseCell) -> SessionState:
    return state.but(two_robots=None)


def _with(
    state: SessionState, change: Callable[[BaseWizard], BaseWizard], *, records: int = 0
) -> SessionState:
    """The procedure at hand, a step further: the exercise's, else that of the open cell."""
    running, free = state.running, state.two_robots
    if running is not None and running.wizard is not None:
        wizard = change(running.wizard)
        return state.but(running=replace(running, wizard=wizard, records=running.records + records))
    if running is not None or free is None:
        raise refusal("no_tracker")
    return state.but(two_robots=replace(free, wizard=change(free.wizard)))


def _tracked(state: SessionState, action: Tracked) -> SessionState:
    point = np.array(action.point)
    return _with(
        state,
        lambda wizard: wizard.record(point, angle=action.angle, name=action.name, sigma=action.sigma),
        records=1,
    )


def _next(state: SessionState, action: TrackerNext) -> SessionState:
    return _with(state, lambda wizard: wizard.advance())


def _back(state: SessionState, action: TrackerUndo) -> SessionState:
    return _with(state, lambda wizard: wizard.undo())


ACTIONS = {
    OpenCell: _open,
    CloseCell: _close,
    Tracked: _tracked,
    TrackerNext: _next,
    TrackerUndo: _back,
}
