"""Why an action was not done: a code for the translations, and a sentence."""

from __future__ import annotations

from typing import Any

from app.calibration.solvers.point_fit import refuse_too_few
from app.errors import ActionRefusedError, TeachframeError, TooFewPointsError

_SENTENCES = {
    "no_step": "this mode has no point called {step!r}; it has {steps}",
    "recorded": "{title} is recorded already; use Re-record to replace it, or Delete first",
    "not_recorded": "{title} is not recorded yet",
    "no_stroke_back": "{title} is no stroke: only a stroke can be made backwards",
    "joint_count": "{robot} has {needed} joints, {given} were given",
    "not_a_number": "joint {joint} is not a number",
    "beyond_limit": "joint {joint} would be beyond its limit",
    "no_frame": "these numbers are no frame",
    "touches": "{mode} takes {least} to {most} touches, not {given}",
    "missing": "not recorded yet: {titles}",
    "no_result": "there is no result yet; press Calculate first",
    "not_direct": "numbers are typed in the mode direct entry; choose it first",
    "not_entered": "no numbers are typed in yet",
    "no_known_tool": "the known tool is not known yet; teach and accept it first, or type it in",
    "cannot_solve": "{reason}",
    "nothing_to_undo": "nothing to undo",
    "nothing_to_redo": "nothing to redo",
    "nothing_to_cancel": "nothing is recorded",
    "no_name": "the tool needs a name",
    "other_robot": "the points were recorded with another arm",
    "exercise_runs": "an exercise is being done; finish it or give it up first",
    "no_exercise": "no exercise is being done",
    "no_tracker": "there is no laser tracker here: open the cell of two robots first",
    "no_load": "nothing hangs on the flange that could be weighed",
    "no_pose": "a weighing run has poses 1 to {most}, not {number}",
    "not_weighed": "{recorded} of {most} poses of the weighing run are recorded",
    "model_kind": "a model of joint logs moves nothing in the practice cell; it takes one of touches or tracker points",
    "model_robot": "the model was learnt on {learnt}, and {robot} stands in the practice cell",
    "unknown": "{reason}",
}


def refusal(code: str, **details: Any) -> ActionRefusedError:
    """The error of this code; `.code` and `.details` (where phrases speak for themselves) are for a translation."""
    error = ActionRefusedError(_SENTENCES[code].format(**details))
    error.code, error.details = code, details  # type: ignore[attr-defined]
    return error


def cannot_solve(error: TeachframeError) -> ActionRefusedError:
    """A refusal of the solver's, in its own words and under its own code (`.why`)."""
    found = refusal("cannot_solve", reason=getattr(error, "said", None) or str(error))
    found.why = getattr(error, "code", "")  # type: ignore[attr-defined]
    return found


def enough_touches(count: int) -> None:
    """Raises ActionRefusedError, with what to do, where so few touches cannot determine a tool point."""
    try:
        refuse_too_few(count)
    except TooFewPointsError as error:
        raise cannot_solve(error) from None
