"""The recorded points to the solver, with everything the session knows about them."""

from __future__ import annotations

from typing import Any

from app.calibration.checks.tool_active import SessionTool
from app.calibration.points import Points
from app.calibration.quality.leave_one_out import leave_one_out
from app.calibration.quality.light import light
from app.calibration.quality.references import gap_to
from app.calibration.quality.rounding import least_turn, rounding
from app.calibration.solving import Solved
from app.calibration.tool import calibrate
from app.session.points import orientation_of, recorded_points
from app.session.refusals import refusal
from app.session.state import DIRECT, SessionState, mode_named


def solve(state: SessionState) -> Solved:
    """The tool frame of the points recorded so far, with its quality.

    Raises:
        TeachframeError: the points cannot determine it; says what to do next.
    """
    points = recorded_points(state)
    orientation = orientation_of(state.mode)
    if orientation is None:
        result = mode_named(state.mode).solve(points.captures, **_options(state, points))
    else:
        result = calibrate(
            points.captures,
            method=state.method,
            orientation=orientation,
            least_turn=least_turn(points),
            context=_context(state, points),
        )
    effect = rounding(points, result)
    gaps = tuple(gap_to(name, stated, result, effect) for name, stated in points.references.items())
    left = leave_one_out(points.captures) if len(result.residual_vectors) else ()
    return Solved(points, result, effect, gaps, left, light(result))


def _context(state: SessionState, points: Points) -> dict[str, Any]:
    """What the checks may know besides the points."""
    if state.tool is None:
        return {"points": points}
    tool = SessionTool(state.tool.name, state.tool.T_flange_tool, recorded=state.source is None)
    return {"points": points, "session_tool": tool}


def _options(state: SessionState, points: Points) -> dict[str, Any]:
    """What a mode with a way of its own has to be told."""
    if state.mode == DIRECT:
        if state.entered is None:
            raise refusal("not_entered")
        entered = state.entered
        return {
            "position": entered.position,
            "angles": entered.angles,
            "angle_convention": entered.convention,
        }
    options: dict[str, Any] = {"context": _context(state, points)}
    if any("known" in c.roles for c in points.captures):
        if state.tool is None:
            raise refusal("no_known_tool")
        options["known_tool"] = state.tool.T_flange_tool.position
    return options
