"""The actions of one attempt, and everything that can be counted in them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.calibration.base.wizard import BaseWizard
from app.errors import InputError
from app.session import SessionState, reduce
from app.session.actions import Begin, Calculate, Finish, Move, Record, ReRecord
from app.session.journal import Entry
from app.session.state import first_state
from app.training.cell import at_touch
from app.training.truth import Truth


@dataclass(frozen=True, eq=False)
class Attempt:
    """One attempt from Begin to Finish.

    Args:
        begin, finish: its first and its last action.
        seconds: how long it took.
        state: the session at its end.
        wizard: the two-robot procedure at its end.
        way: (k, n) joint positions the arm went through, in order.
        misses: true tip to true spike [m] of the touches that are in the list at the end, by step.
        records, repeats, calculations: how often.
    """

    begin: Begin
    finish: Finish
    seconds: float
    state: SessionState
    wizard: BaseWizard | None
    way: np.ndarray
    misses: dict[str, float]
    records: int
    repeats: int
    calculations: int


def last_attempt(entries: Sequence[Entry]) -> tuple[Entry, ...]:
    """The entries of the newest attempt, from its Begin to its Finish or to the end; () where there is none."""
    begins = [i for i, entry in enumerate(entries) if isinstance(entry.action, Begin)]
    if not begins:
        return ()
    mine = entries[begins[-1] :]
    ends = [i for i, entry in enumerate(mine) if isinstance(entry.action, Finish)]
    return tuple(mine[: ends[0] + 1] if ends else mine)


def follow(entries: Sequence[Entry], truth: Truth | None) -> Attempt:
    """Does the actions of an attempt again and counts.

    Args:
        entries: from Begin to Finish.
        truth: for the misses; None for the two-robot cell.

    Raises:
        InputError: not a whole attempt.
    """
    if not entries or not isinstance(begin := entries[0].action, Begin):
        raise InputError("not an attempt", expected="actions from begin to finish")
    if not isinstance(finish := entries[-1].action, Finish):
        raise InputError("this attempt is not finished", expected="finish as its last action")
    state = first_state()
    way: list[tuple[float, ...]] = []
    missed: dict[str, float] = {}
    records = repeats = calculations = 0
    wizard = None
    for entry in entries:
        action = entry.action
        if isinstance(action, Record | ReRecord) and truth is not None:
            q = np.array(state.q if action.q is None else action.q)
            missed[action.step] = at_touch(truth, records + 1).distance(q)
        state = reduce(state, action)
        if isinstance(action, Begin):
            way.append(state.q)
        elif isinstance(action, Move):
            way += [*(p for p in action.path if len(p) == len(action.q)), action.q]
        elif isinstance(action, Record | ReRecord):
            records += 1
            repeats += isinstance(action, ReRecord)
        elif isinstance(action, Calculate):
            calculations += 1
        if state.running is not None:
            wizard = state.running.wizard
    touches = {s.key for s in state.steps if "touch" in s.roles}
    return Attempt(
        begin,
        finish,
        entries[-1].t - entries[0].t,
        state,
        wizard,
        np.array(way),
        {key: miss for key, miss in missed.items() if key in state.captures and key in touches},
        records,
        repeats,
        calculations,
    )
