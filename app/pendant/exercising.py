"""What an exercise changes for a pendant: its cell, and the helps it allows."""

from __future__ import annotations

from app.pendant.aids import Aids
from app.session import SessionState
from app.training.exercise import exercise


def aids_of(state: SessionState) -> Aids:
    """The helps of the exercise that is being done; all of them where none is."""
    if state.running is None:
        return Aids()
    allowed = exercise(state.running.begun.exercise).allowed
    return Aids(
        distance=allowed.distance,
        closeup=allowed.closeup,
        next_touch=allowed.next_touch,
        handle=allowed.handle,
        touch=allowed.touch,
    )


def cell_key(state: SessionState) -> tuple[object, ...]:
    """What the cell that is shown depends on; another key means another cell."""
    tool = state.tool if state.running is not None else None
    return (state.source, state.cell_model, state.running, tool)
