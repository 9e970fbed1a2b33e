"""What the wizard is about: arm, mode, estimator; and where the arm stands."""

from __future__ import annotations

import math

import numpy as np

from app.calibration.tool import METHODS
from app.diagnosis.model_checks import fitting
from app.diagnosis.models.kinematic.predict import model_flange_matrix
from app.errors import TeachframeError, UnknownNameError
from app.geometry import Pose
from app.session.actions import ChooseMethod, ChooseMode, ChooseRobot, Move, SetUserFrame, UseModel
from app.session.refusals import refusal
from app.session.state import SessionState, first_state, mode_named

#: How far beyond a limit [rad or m] a joint may be written, because it was read from a screen with few digits.
LIMIT_SLACK = 1e-6
#: No fault moves a flange farther than this [m].
_BENT = 5.0


def _choose_robot(state: SessionState, action: ChooseRobot) -> SessionState:
    if state.running is not None:
        raise refusal("exercise_runs")
    try:
        fresh = first_state(action.robot, state.mode)
    except UnknownNameError as error:
        raise refusal("unknown", reason=str(error)) from None
    return fresh.but(touches=state.touches, method=state.method, two_robots=state.two_robots)


def choose_mode(state: SessionState, action: ChooseMode) -> SessionState:
    """Another wizard, or another number of touches; raises ActionRefusedError."""
    try:
        mode = mode_named(action.mode)
    except UnknownNameError as error:
        raise refusal("unknown", reason=str(error)) from None
    touches = mode.default_touches if action.touches is None else action.touches
    if not mode.least_touches <= touches <= mode.most_touches:
        raise refusal(
            "touches", mode=mode.title, least=mode.least_touches, most=mode.most_touches, given=touches
        )
    kept = {
        step.key: state.captures[step.key]
        for step in mode.steps(touches)
        if step.key in state.captures and state.captures[step.key].role.removeprefix("-") == step.role
    }
    comments = {key: text for key, text in state.comments.items() if key in kept}
    return state.but(mode=mode.key, touches=touches, captures=kept, comments=comments, result=None)


def _choose_method(state: SessionState, action: ChooseMethod) -> SessionState:
    if action.method not in METHODS:
        raise refusal("unknown", reason=f"unknown estimator {action.method!r}: {' or '.join(METHODS)}")
    return state.but(method=action.method, result=None)


def checked_joints(state: SessionState, q: tuple[float, ...]) -> tuple[float, ...]:
    """The joint positions if the arm can stand there; raises ActionRefusedError."""
    robot = state.model
    if len(q) != robot.joint_count:
        raise refusal("joint_count", robot=state.robot, needed=robot.joint_count, given=len(q))
    for number, value in enumerate(q, 1):
        if not math.isfinite(value):
            raise refusal("not_a_number", joint=number)
    beyond = (np.array(q) < robot.lower - LIMIT_SLACK) | (np.array(q) > robot.upper + LIMIT_SLACK)
    if beyond.any():
        raise refusal("beyond_limit", joint=int(np.flatnonzero(beyond)[0]) + 1)
    return tuple(float(v) for v in q)


def _move(state: SessionState, action: Move) -> SessionState:
    return state.but(q=checked_joints(state, action.q))


def _set_user_frame(state: SessionState, action: SetUserFrame) -> SessionState:
    if action.place is None:
        return state.but(user_frame=None)
    length = float(np.linalg.norm(action.quaternion))
    if not all(map(math.isfinite, action.place)) or not math.isfinite(length) or length == 0.0:
        raise refusal("no_frame")
    return state.but(
        user_frame=Pose.from_quaternion(np.array(action.quaternion) / length, np.array(action.place))
    )


def _use_model(state: SessionState, action: UseModel) -> SessionState:
    model = action.model
    if state.running is not None:  # an exercise has a cell of its own
        raise refusal("exercise_runs")
    if model is not None:
        if model.kind != "static":
            raise refusal("model_kind")
        if model.robot != state.robot:
            raise refusal("model_robot", learnt=model.robot, robot=state.robot)
        try:
            fitting(model, state.model)
            bent = model_flange_matrix(state.model, model, np.array(state.q))
        except TeachframeError as error:  # an effect nobody knows, a value that is missing
            raise refusal("unknown", reason=str(error)) from None
        except (KeyError, TypeError, ValueError, IndexError, ArithmeticError) as error:  # a place it has not
            raise refusal(
                "unknown", reason=f"the model cannot be applied ({type(error).__name__}: {error})"
            ) from None
        if (
            not np.isfinite(bent).all()
            or np.abs(bent - state.model.forward(np.array(state.q)).matrix).max() > _BENT
        ):
            raise refusal("unknown", reason="the model moves the arm by more than its own size")
    return state.but(cell_model=model)


ACTIONS = {
    UseModel: _use_model,
    ChooseRobot: _choose_robot,
    ChooseMode: choose_mode,
    ChooseMethod: _choose_method,
    Move: _move,
    SetUserFrame: _set_user_frame,
}
