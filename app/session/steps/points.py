"""Recording points, taking them away, loading them from a file."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app.calibration.captures import Capture, Step
from app.calibration.tool import METHODS
from app.errors import TeachframeError, UnknownNameError
from app.session.actions import Cancel, Comment, Delete, LoadPoints, Record, ReRecord
from app.session.points import loaded_points
from app.session.refusals import enough_touches, refusal
from app.session.state import SessionState, mode_named
from app.session.steps.setup import checked_joints

#: Roles of which a mode takes as many as it is asked for.
_COUNTED = frozenset({"touch", "plane"})
#: Roles of strokes, which may be made backwards.
_STROKES = frozenset({"x", "y", "z"})


def known_step(state: SessionState, key: str) -> Step:
    """The wizard's row of this key; raises ActionRefusedError."""
    step = state.step(key)
    if step is None:
        raise refusal("no_step", step=key, steps=", ".join(s.key for s in state.steps))
    return step


def _record(state: SessionState, action: Record) -> SessionState:
    step = known_step(state, action.step)
    if step.key in state.captures:
        raise refusal("recorded", title=step.title)
    return _captured(state, step, action.q, action.back)


def _re_record(state: SessionState, action: ReRecord) -> SessionState:
    step = known_step(state, action.step)
    if step.key not in state.captures:
        raise refusal("not_recorded", title=step.title)
    return _captured(state, step, action.q, action.back)


def _captured(state: SessionState, step: Step, q: tuple[float, ...] | None, back: bool) -> SessionState:
    """The flange pose is what the controller shows: its nominal forward kinematics of the angles it reads."""
    if back and step.role not in _STROKES:
        raise refusal("no_stroke_back", title=step.title)
    joints = state.q if q is None else checked_joints(state, q)
    row = [s.key for s in state.steps].index(step.key) + 1
    angles = np.array(joints)
    angles.flags.writeable = False
    capture = Capture(
        step.key, f"-{step.role}" if back else step.role, state.model.forward(angles), angles, row
    )
    running = state.running and replace(state.running, records=state.running.records + 1)
    return state.but(
        q=joints,
        captures={**state.captures, step.key: capture},
        result=None,
        source=None,
        running=running,
    )


def _delete(state: SessionState, action: Delete) -> SessionState:
    step = known_step(state, action.step)
    if step.key not in state.captures:
        raise refusal("not_recorded", title=step.title)
    return state.but(
        captures={key: c for key, c in state.captures.items() if key != step.key},
        comments={key: text for key, text in state.comments.items() if key != step.key},
        result=None,
    )


def _comment(state: SessionState, action: Comment) -> SessionState:
    step = known_step(state, action.step)
    return state.but(comments={**state.comments, step.key: action.text.strip()})


def _cancel(state: SessionState, action: Cancel) -> SessionState:
    if not state.captures and state.result is None and state.entered is None:
        raise refusal("nothing_to_cancel")
    return state.but(captures={}, comments={}, result=None, source=None, entered=None)


def _load(state: SessionState, action: LoadPoints) -> SessionState:
    """Rows are given to the wizard's steps in the order in which they ask for that role."""
    if state.running is not None:
        raise refusal("exercise_runs")
    if action.robot and action.robot != state.robot:
        raise refusal("other_robot")
    try:
        mode = mode_named(action.mode)
    except UnknownNameError as error:
        raise refusal("unknown", reason=str(error)) from None
    if action.method not in METHODS:
        raise refusal("unknown", reason=f"unknown estimator {action.method!r}")
    try:
        points = loaded_points(action)
    except TeachframeError as error:
        raise refusal("unknown", reason=str(error)) from None
    touches = sum(bool(_COUNTED & set(capture.roles)) for capture in points.captures)
    if touches < mode.least_touches:
        enough_touches(touches)
    if not mode.least_touches <= touches <= mode.most_touches:
        raise refusal(
            "touches", mode=mode.title, least=mode.least_touches, most=mode.most_touches, given=touches
        )
    steps = mode.steps(touches)
    left = list(points.captures)
    captures = {}
    for step in steps:
        found = next((c for c in left if set(_forward(c)) == set(step.roles)), None)
        if found is None:
            raise refusal("missing", titles=f"{step.title} (role {step.role})")
        left.remove(found)
        captures[step.key] = replace(found, step_key=step.key)
    return state.but(
        mode=mode.key,
        touches=touches,
        method=action.method,
        captures=captures,
        comments={},
        result=None,
        source=action,
    )


def _forward(capture: Capture) -> tuple[str, ...]:
    return tuple(role.removeprefix("-") for role in capture.roles)


ACTIONS = {
    Record: _record,
    ReRecord: _re_record,
    Delete: _delete,
    Comment: _comment,
    Cancel: _cancel,
    LoadPoints: _load,
}
