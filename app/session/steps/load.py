"""A load that is weighed: what hangs there, the poses of the run, what it found."""

from __future__ import annotations

from dataclasses import replace

from app.session.actions import HangLoad, WeighAt, Weighed
from app.session.refusals import refusal
from app.session.state import SessionState, Weighing
from app.session.steps.setup import checked_joints

#: Poses of a run: gravity pulls at the load from as many sides.
POSES = 4


def _hang(state: SessionState, action: HangLoad) -> SessionState:
    if state.running is not None:
        raise refusal("exercise_runs")
    return state.but(load=Weighing(action.seed))


def _at(state: SessionState, action: WeighAt) -> SessionState:
    load = _hanging(state)
    if not 0 <= action.number < POSES:
        raise refusal("no_pose", number=action.number + 1, most=POSES)
    poses = {number: q for number, q in load.poses.items() if number != action.number}
    if action.q is not None:
        poses[action.number] = checked_joints(state, action.q)
    return state.but(load=replace(load, poses=poses, found=None))


def _weighed(state: SessionState, action: Weighed) -> SessionState:
    load = _hanging(state)
    if len(load.poses) < POSES:
        raise refusal("not_weighed", recorded=len(load.poses), most=POSES)
    return state.but(load=replace(load, found=action))


def _hanging(state: SessionState) -> Weighing:
    if state.load is None:
        raise refusal("no_load")
    return state.load


ACTIONS = {HangLoad: _hang, WeighAt: _at, Weighed: _weighed}
