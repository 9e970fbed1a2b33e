"""What an exercise changes for a context: its cell, and the helps it allows."""

from __future__ import annotations

from dataclasses import fields

from app.screens.aids import Aids
from app.session import SessionState
from app.training.exercise import begun_exercise


def aids_of(state: SessionState) -> Aids:
    """The helps of the exercise that is being done; all of them where none is."""
    if state.running is None:
        return Aids()
    begun = state.running.begun
    allowed = begun_exercise(begun).allowed
    given = {f.name: getattr(allowed, f.name) and f.name not in begun.without for f in fields(Aids)}
    return Aids(**given)


def cell_key(state: SessionState) -> tuple[object, ...]:
    """What the cell that is shown depends on; another key means another cell."""
    tool = state.tool if state.running is not None else None
    return (state.source, state.cell_model, state.running, tool)
