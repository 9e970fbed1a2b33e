"""Why an action was not done: a code for the translations, and a sentence."""

from __future__ import annotations

from typing import Any

from app.errors import ActionRefusedError

_SENTENCES = {
    "no_step": "this mode has no point called {step!r}; it has {steps}",
    "recorded": "{title} is recorded already; use Re-record to replace it, or Delete first",
    "not_recorded": "{title} is not recorded yet",
    "joint_count": "{robot} has {needed} joints, {given} were given",
    "not_a_number": "joint {joint} is not a number",
    "beyond_limit": "joint {joint} would be beyond its limit",
    "touches": "{mode} takes {least} to {most} touches, not {given}",
    "missing": "not recorded yet: {titles}",
    "no_result": "there is no result yet; press Calculate first",
    "cannot_solve": "{reason}",
    "nothing_to_undo": "nothing to undo",
    "nothing_to_redo": "nothing to redo",
    "nothing_to_cancel": "nothing is recorded",
    "no_name": "the tool needs a name",
    "other_robot": "the points were recorded with another arm",
    "unknown": "{reason}",
}


def refusal(code: str, **details: Any) -> ActionRefusedError:
    """The error of this code; `.code` and `.details` are for a translation."""
    error = ActionRefusedError(_SENTENCES[code].format(**details))
    error.code, error.details = code, details  # type: ignore[attr-defined]
    return error
