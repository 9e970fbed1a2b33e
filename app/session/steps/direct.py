"""A tool frame typed in."""

from __future__ import annotations

from app.calibration.modes.direct import MODE
from app.errors import TeachframeError
from app.session.actions import Enter
from app.session.refusals import refusal
from app.session.state import DIRECT, SessionState


def _enter(state: SessionState, action: Enter) -> SessionState:
    if state.mode != DIRECT:
        raise refusal("not_direct")
    try:
        MODE.solve((), position=action.position, angles=action.angles, angle_convention=action.convention)
    except TeachframeError as error:
        raise refusal("unknown", reason=str(error)) from None
    return state.but(entered=action, result=None, source=None)


ACTIONS = {Enter: _enter}
