"""Calculate, accept."""

from __future__ import annotations

from app.errors import TeachframeError
from app.session.actions import Accept, Calculate
from app.session.refusals import refusal
from app.session.solving import solve
from app.session.state import SessionState, Tool


def _calculate(state: SessionState, action: Calculate) -> SessionState:
    if state.missing:
        raise refusal("missing", titles=", ".join(step.title for step in state.missing))
    try:
        return state.but(result=solve(state))
    except TeachframeError as error:  # too alike, all about one axis: the sentence says what to do next
        raise refusal("cannot_solve", reason=str(error)) from None


def _accept(state: SessionState, action: Accept) -> SessionState:
    if state.result is None:
        raise refusal("no_result")
    name = action.name.strip()
    if not name:
        raise refusal("no_name")
    kept = tuple(tool for tool in state.tools if tool.name != name)
    return state.but(tools=(*kept, Tool(name, state.result.result.T_flange_tool)))


ACTIONS = {Calculate: _calculate, Accept: _accept}
