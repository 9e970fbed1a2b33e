"""The direction of dry friction: sharp at rest, or smoothed over a speed that a log tells."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from app.diagnosis.models.dynamic.state import State

#: How a saved law of dry friction keeps its sharpness [rad/s or m/s].
WIDTH = "fixed_width"


def direction(state: State, joint: int, fixed: Mapping[str, float]) -> np.ndarray:
    """(M,) between -1 and 1, of joint (from 0)."""
    return state.direction(joint, fixed.get(WIDTH))
