"""A recorded session played again: the arm goes where it went, each action is told; nothing is changed."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from app.pendant import motion
from app.session import reduce
from app.session.actions import Move
from app.session.journal import Recorded
from app.session.state import SessionState, first_state

if TYPE_CHECKING:
    from app.pendant.client import Pendant

_READ = 0.6  # seconds an action that moves nothing is shown


def played(pendant: Pendant, recorded: Recorded, told) -> Iterator[None]:
    """The steps of a replay, for the worker.

    Args:
        recorded: whose actions.
        told: called with (number, time of day, key of the action's name, state) for each.
    """
    state = first_state()
    for entry in recorded.entries:
        state = reduce(state, entry.action)
        clock = time.strftime("%H:%M:%S", time.localtime(entry.t))
        told(entry.n, clock, type(entry.action).__struct_config__.tag, state)
        if state.robot == pendant.model.name and isinstance(entry.action, Move):
            for stop in (*entry.action.path[::5], entry.action.q):
                yield from motion.move(
                    pendant.stage.arm.q,
                    np.array(stop),
                    lambda q: pendant.stage.pose(q, pendant.world, pendant.hand(q)),
                )
        else:
            yield from motion.pause(_READ)


def back(pendant: Pendant) -> None:
    """The arm stands where its own session has it."""
    pendant.stage.pose(pendant.q, pendant.world, pendant.hand())


def summary(state: SessionState) -> tuple[int, str]:
    """Points recorded and the tool that is active, of a session's end."""
    return len(state.captures), state.tool.name if state.tool is not None else ""
