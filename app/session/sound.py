"""Whether an action can be meant at all: it may come from a file that somebody made up.

Every number is finite and of a size that an arm's cell has, every text and list is bounded. What the state allows is
asked afterwards, by the action's own step.
"""

from __future__ import annotations

from app.errors import TeachframeError
from app.session.actions import (
    AnyAction,
    Begin,
    Enter,
    HangLoad,
    LoadPoints,
    Move,
    OpenCell,
    Record,
    ReRecord,
    SetUserFrame,
    UseModel,
    WeighAt,
)
from app.session.refusals import refusal

#: Metres, radians, seconds since 1970: nothing in a session is larger.
LARGEST = 1e11
#: Characters of one text; a note is shorter.
LONGEST_TEXT = 4000
#: Entries of one list: rows of a points file, joint positions of a way.
MOST_ENTRIES = 200_000
#: Levels of lists within lists.
DEEPEST = 8
#: Numpy takes seeds from 0; they are kept as 64-bit integers.
LARGEST_SEED = 2**63
#: Actions whose own step looks at each number and names it; only a way is not looked at there.
_ASKED_BY_THEIR_STEP = (Move, Record, ReRecord, Enter, SetUserFrame, WeighAt)
#: A place in a points file [m], and an angle or a quaternion's part.
_FARTHEST = 1e5


def check_sound(action: AnyAction) -> None:
    """Raises ActionRefusedError where the action holds what nobody can mean."""
    if isinstance(action, UseModel):
        _check_model(action)
        return
    names = ("path",) if isinstance(action, _ASKED_BY_THEIR_STEP) else action.__struct_fields__
    reason = _reason([getattr(action, name, None) for name in names])
    if not reason and isinstance(action, LoadPoints):
        reason = _points_reason(action)
    if not reason and isinstance(action, Begin | OpenCell | HangLoad) and not 0 <= action.seed < LARGEST_SEED:
        reason = f"the seed {action.seed} is not between 0 and {LARGEST_SEED}"
    if reason:
        raise refusal("unknown", reason=reason)


def _check_model(action: UseModel) -> None:
    from app.diagnosis.model_checks import checked

    if action.model is None:
        return
    try:
        checked(action.model)
    except TeachframeError as error:
        raise refusal("unknown", reason=str(error)) from None


def _reason(value: object, depth: int = 0) -> str:
    """Why a value cannot be; "" where it can."""
    if isinstance(value, bool) or value is None:
        return ""
    if isinstance(value, int | float):
        return "" if abs(value) <= LARGEST or isinstance(value, int) else f"the number {value!r} cannot be"
    if isinstance(value, str):
        return "" if len(value) <= LONGEST_TEXT else f"a text of {len(value)} characters"
    if depth >= DEEPEST:
        return f"lists within lists, deeper than {DEEPEST}"
    inside = [*value.keys(), *value.values()] if isinstance(value, dict) else list(value)  # type: ignore[call-overload]
    if len(inside) > MOST_ENTRIES:
        return f"a list of {len(inside)} entries"
    return next((found for part in inside if (found := _reason(part, depth + 1))), "")


def _points_reason(action: LoadPoints) -> str:
    """Why a loaded file's columns and rows do not belong together."""
    rows, columns = len(action.roles), len(action.columns)
    if not rows or len(action.rows) != rows or len(action.values) != rows:
        return f"{rows} roles, {len(action.rows)} row numbers and {len(action.values)} rows of numbers"
    if len(action.steps) != columns or any(len(row) != columns for row in action.values):
        return f"a row of numbers does not have the {columns} numbers of the columns"
    if len(set(action.columns)) != columns:
        return "a column stands there twice"
    if not action.angles and not action.robot:
        return "points without angles and without a robot"
    if action.joints and (len(action.joints) != rows or not action.robot):
        return f"{len(action.joints)} joint positions for {rows} rows"
    beyond = max((abs(v) for row in (*action.values, *action.joints) for v in row), default=0.0)
    return "" if beyond <= _FARTHEST else f"the number {beyond:g} is no place and no angle of an arm"
