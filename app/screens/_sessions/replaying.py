"""A recorded session played again: the arm goes where it went, each action is told; nothing is changed.

The arm obeys here as everywhere: it moves while the enabling switch is held, at the speed that is set.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from app.kinematics import load_robot
from app.session import reduce, replay
from app.session.actions import Begin, Move
from app.session.journal import Recorded, read_journal
from app.session.motion.pace import pause
from app.session.state import SessionState, first_state, grant_robot, known_robot, robot_named
from app.training.exercise import begun_exercise

if TYPE_CHECKING:
    from app.screens.context import Context

_READ = 0.6  # seconds an action that moves nothing is shown
_EVERY = 5  # of the poses of a way, each so many-th is gone through


def played(
    context: Context, recorded: Recorded, told: Callable[[int, str, str, SessionState], None]
) -> Iterator[None]:
    """The steps of a replay, for the worker.

    Args:
        recorded: whose actions.
        told: called with (number, time of day, key of the action's name, state) for each.
    """
    state = first_state()
    at = context.stage.arm.q

    def show(q: np.ndarray) -> None:
        context.stage.pose(q, context.world, context.hand(q))

    for entry in recorded.entries:
        state = reduce(state, entry.action)
        clock = time.strftime("%H:%M:%S", time.localtime(entry.t))
        told(entry.n, clock, str(type(entry.action).__struct_config__.tag), state)
        if state.robot == context.session.state.robot and isinstance(entry.action, Move):
            for stop in (*entry.action.path[::_EVERY], entry.action.q):
                yield from context.drive.paced(at, np.array(stop), show)
                at = np.array(stop)
        else:
            yield from pause(context.drive, _READ)


def replayable(path: Path, arms: Mapping[str, str]) -> Recorded:
    """A journal somebody sent; what cannot be replayed is not taken in.

    Args:
        path: the file.
        arms: name -> address of the arms that he brought himself; of others he may use the shipped ones.

    Raises:
        FileFormatError, ActionRefusedError: it is none, or an action in it is not possible.
    """
    recorded = read_journal(path)
    for name, address in arms.items():
        grant_robot(name, lambda _, address=address: load_robot(address))
    replay(recorded)
    for entry in recorded.entries:
        if isinstance(entry.action, Begin):
            begun_exercise(entry.action)  # nor what brings an exercise nobody can do
    return recorded


def back(context: Context) -> None:
    """The arm stands where its own session has it."""
    context.stage.pose(context.q, context.world, context.hand())


def title_of(robot: str, language: str) -> str:
    """What an arm is called in a list; one that is not here any more by its name alone."""
    if not robot:
        return "?"
    return robot_named(robot).said("title", language) if known_robot(robot) else robot.partition("~")[0][:40]


def summary(state: SessionState) -> tuple[int, str]:
    """Points recorded and the tool that is active, of a session's end."""
    return len(state.captures), state.tool.name if state.tool is not None else ""
