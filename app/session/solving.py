"""The recorded points to the mode's solver, with everything the session knows about them."""

from __future__ import annotations

from app.calibration.result import ToolCalibration
from app.session.state import SessionState, mode_named


def solve(state: SessionState) -> ToolCalibration:
    """The tool frame of the points recorded so far.

    Raises:
        TeachframeError: the points cannot determine it; says what to do next.
    """
    return mode_named(state.mode).solve(state.ordered, method=state.method)
