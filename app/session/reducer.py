"""state, action -> state: finds the family that knows the action, and keeps what Undo needs."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

from app import catalog
from app.session.actions import (
    AnyAction,
    Begin,
    ChooseRobot,
    CloseCell,
    Finish,
    HangLoad,
    Move,
    OpenCell,
    Redo,
    SetUserFrame,
    Tracked,
    TrackerNext,
    TrackerUndo,
    Undo,
    WeighAt,
    Weighed,
)
from app.session.refusals import refusal
from app.session.sound import check_sound
from app.session.state import SessionState

STEPS = "app.session.steps"

#: No change of the list: what Undo takes back stays the same.
_TRACKER = Tracked | TrackerNext | TrackerUndo | OpenCell | CloseCell
_ASIDE = Move | SetUserFrame | Finish | HangLoad | WeighAt | Weighed | _TRACKER

Reducer = Callable[[SessionState, AnyAction], SessionState]


@cache
def _reducers() -> dict[type, Reducer]:
    found: dict[type, Reducer] = {}
    for module in catalog.modules(STEPS).values():
        found.update(module.ACTIONS)
    return found


def reduce(state: SessionState, action: AnyAction) -> SessionState:
    """The state after an action. Pure: the state given is left as it was.

    Raises:
        ActionRefusedError: the state does not allow the action; says what to do instead.
    """
    check_sound(action)
    if isinstance(action, Undo):
        return _undo(state)
    if isinstance(action, Redo):
        return _redo(state)
    after, count = _reducers()[type(action)](state, action), state.count + 1
    if isinstance(action, _ASIDE):
        return after.but(count=count)
    if isinstance(action, ChooseRobot | Begin):  # another arm's points mean nothing here
        return after.but(count=count, before=None, after=None)
    return after.but(count=count, before=state, after=None)


def _undo(state: SessionState) -> SessionState:
    if state.before is None:
        raise refusal("nothing_to_undo")
    return state.before.but(**_standing(state), after=state)


def _redo(state: SessionState) -> SessionState:
    if state.after is None:
        raise refusal("nothing_to_redo")
    return state.after.but(**_standing(state), before=state)


def _standing(state: SessionState) -> dict[str, Any]:
    """What Undo and Redo leave alone."""
    kept = {name: getattr(state, name) for name in ("q", "user_frame", "running", "two_robots", "load")}
    return {**kept, "count": state.count + 1}
