"""Calculate, accept."""

from __future__ import annotations

from app.errors import ActionRefusedError, TeachframeError
from app.session.actions import Accept, Calculate
from app.session.refusals import cannot_solve, enough_touches, refusal
from app.session.solving import solve
from app.session.state import SessionState, Tool

#: The mode in which one touch is enough.
REFERENCE = "reference"


def _calculate(state: SessionState, action: Calculate) -> SessionState:
    if state.missing:
        touches = sum("touch" in capture.roles for capture in state.captures.values())
        if touches and any("touch" in step.roles for step in state.missing) and state.mode != REFERENCE:
            enough_touches(touches)
        raise refusal("missing", titles=", ".join(step.title for step in state.missing))
    try:
        return state.but(result=solve(state))
    except ActionRefusedError:
        raise
    except (
        TeachframeError
    ) as error:  # all about one axis, parallel strokes: the sentence says what to do next
        raise cannot_solve(error) from None


def _accept(state: SessionState, action: Accept) -> SessionState:
    if state.result is None:
        raise refusal("no_result")
    name = action.name.strip()
    if not name:
        raise refusal("no_name")
    kept = tuple(tool for tool in state.tools if tool.name != name)
    return state.but(tools=(*kept, Tool(name, state.result.result.T_flange_tool)))


ACTIONS = {Calculate: _calculate, Accept: _accept}
