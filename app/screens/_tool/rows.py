"""The list of the wizard: a row a point, with its state, its lamp and reason, record, go to, delete."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.calibration.captures import of_role
from app.panel import Row
from app.screens._tool.hand import AXES
from app.screens._tool.words import Words
from app.session import SessionState
from app.units import from_mm, mm

if TYPE_CHECKING:
    from app.screens.context import Context

_GOOD, _FAIR = from_mm(0.5), from_mm(1.0)  # what makers count as good, and as fit to use, for one point


def rows_of(context: Context, words: Words, state: SessionState) -> tuple[Row, ...]:
    """All rows as the page draws them."""
    t, missing = context.t, state.missing
    misses = _misses(state)
    rows = []
    shown = len(state.steps) if context.demonstrated is None else context.demonstrated
    for number, step in enumerate(state.steps):
        recorded = step.key in state.captures and number < shown
        labels = [("record", t("tool.re_record" if recorded else "tool.record"))]
        if step.role in AXES and not recorded:
            labels.append(("back", t("tool.record_back", axis=step.role.upper())))
        if recorded:
            labels += [("go", t("tool.go")), ("delete", t("tool.delete"))]
        light, note = _light(context, state, step.key, misses) if recorded else ("", "")
        now = number == shown or (bool(missing) and step is missing[0])
        rows.append(
            Row(
                key=step.key,
                title=words.step(step).title,
                state="done" if recorded else "now" if now else "open",
                light=light,
                note=note or ("" if recorded else t("tool.row_now" if now else "tool.row_open")),
                actions=tuple(labels),
            )
        )
    return tuple(rows)


def _misses(state: SessionState) -> dict[str, float]:
    """What each touch misses the found point by [m], by step; empty without a result."""
    if state.result is None or not len(state.result.result.residual_vectors):
        return {}
    touches = of_role(state.ordered, "touch")
    per_point = state.result.result.per_point
    if len(touches) != len(per_point):
        return {}
    return {c.step_key: float(miss) for c, miss in zip(touches, per_point, strict=True)}


def _light(context: Context, state: SessionState, key: str, misses: dict[str, float]) -> tuple[str, str]:
    """Lamp and reason of one point: by its miss once there is a result, by contact before."""
    t = context.t
    capture = state.captures.get(key)
    if capture is None:
        return "", ""
    if key in misses:
        miss = misses[key]
        colour = "green" if miss <= _GOOD else "yellow" if miss <= _FAIR else "red"
        return colour, t("tool.row_miss", mm=f"{mm(miss):.2f}")
    if capture.role.startswith("-"):
        return "green", t("tool.row_recorded_back")
    known = context.aids.light and capture.q is not None and state.source is None
    if known and context.world.off(np.array(capture.q), capture.roles) > context.world.contact_distance:
        return "yellow", t("tool.row_in_the_air")
    return "green", t("tool.row_recorded")
