"""The exercise that is being done, in the fixed line on top: its name, and its time."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from app.session.state import Running
from app.training.exercise import begun_exercise
from app.training.levels import level_of

if TYPE_CHECKING:
    from app.screens.context import Context


def title(context: Context, now: Running) -> str:
    """Its name and level."""
    name = begun_exercise(now.begun).said(context.language).title
    return f"{name} · {context.t(f'training.level_{level_of(now.begun)}')}"


def clock(now: Running) -> str:
    """The time since it was begun, and that it may take."""
    seconds = max(0, int(time.time() - now.begun.at))
    minutes = begun_exercise(now.begun).aims.minutes
    return f"{seconds // 60}:{seconds % 60:02d} / {minutes:g}:00"
