"""What a replay prints: the same page, and the same JSON, as `teachframe solve` for the same points."""

from __future__ import annotations

import msgspec

from app.calibration.solving import to_json
from app.calibration.text import page
from app.session.state import SessionState, mode_named


def report_text(state: SessionState) -> str:
    """The result as a page; where there is none, what is still missing."""
    if state.result is not None:
        return page(state.result)
    recorded, missing = len(state.captures), ", ".join(step.title for step in state.missing)
    lines = [
        f"{state.model.title}, {mode_named(state.mode).title}: {recorded} of {len(state.steps)} points, no result"
    ]
    if missing:
        lines.append(f"not recorded: {missing}")
    lines += [f"accepted: {tool.name}" for tool in state.tools]
    return "\n".join(lines)


def report_json(state: SessionState) -> str | None:
    """The object teachframe.tool/1 on one line; None without a result."""
    return None if state.result is None else msgspec.json.encode(to_json(state.result.result)).decode()
