"""Which of the wizard's keys is pressed next: it is the one that stands out."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.calibration.captures import Step
from app.errors import ActionRefusedError
from app.screens._tool.hand import AXES, THERE, TOUCHED
from app.screens._tool.recording import Recording
from app.simulation.pointing import POINTED

if TYPE_CHECKING:
    from app.screens.context import Context

GHOST, HAND, RECORD, JOG = "ghost", "hand", "record", "jog"


def leads(context: Context, step: Step, ghost: np.ndarray | None) -> str:
    """The key for the step at hand, as the arm stands: to the ghost, the hand's help, or to record; else jog.

    Args:
        context: whose arm and aids.
        step: at hand.
        ghost: (n,) where the key to the ghost leads; None where none is proposed.
    """
    if step.role in AXES:
        return RECORD if _stroke_made(context, step) else HAND
    if not (TOUCHED | POINTED) & set(step.roles):
        return RECORD
    if not context.aids.touch:  # the arm is brought there by hand; how far it is, only the light may tell
        return JOG if _recorded_here(context) or (context.aids.light and _away(context, step)) else RECORD
    if _recorded_here(context):  # the next touch has to be another one
        return HAND if ghost is None else GHOST
    if ghost is not None and np.array_equal(ghost, context.q):
        # A ghost is worked out, not felt: touches recorded there have no scatter, and a tool of 0.00 mm says nothing.
        return HAND
    if context.aids.light and not _away(context, step):
        return RECORD
    return HAND if ghost is None or _at(ghost, context.q) else GHOST


def _recorded_here(context: Context) -> bool:
    captures = context.session.state.captures.values()
    return any(c.q is not None and _at(np.array(c.q), context.q) for c in captures)


def _away(context: Context, step: Step) -> bool:
    return context.world.off(context.q, step.roles) > context.world.contact_distance


def _at(q: np.ndarray, now: np.ndarray) -> bool:
    return q.shape == now.shape and float(np.abs(q - now).max()) < THERE


def _stroke_made(context: Context, step: Step) -> bool:
    """True where recording would not refuse the stroke, and it is not one that is recorded already."""
    try:
        Recording(context).check_stroke(step)
    except ActionRefusedError:
        return False
    return not _recorded_here(context)
