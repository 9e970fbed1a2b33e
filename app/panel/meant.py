"""What a page says of a widget, looked at before anybody hears it: a page may say anything."""

from __future__ import annotations

import math
from typing import Any

from app.panel.widgets import Value, Widget

_LONGEST_TEXT = 2000  # characters; a name or a path is shorter


def meant(data: Widget, value: Any) -> tuple[bool, Value]:
    """Whether a value from a page is one this widget can have, and the value as it is kept."""
    kind = data.kind
    if kind in ("choice", "buttons"):
        return isinstance(value, str) and value in data.options, value
    if kind == "button":
        return True, None
    if kind == "check":
        return isinstance(value, bool), value
    if kind == "text":
        return isinstance(value, str) and len(value) <= _LONGEST_TEXT, value
    if kind == "vector":
        known = data.value if isinstance(data.value, tuple) else ()
        fits = isinstance(value, list) and len(value) == len(known) and all(map(_finite, value))
        return fits, tuple(float(v) for v in value) if fits else None
    if kind in ("number", "slider"):
        if not _finite(value):
            return False, None
        low, high = data.low, data.high
        value = float(value)
        value = value if low is None else max(value, low)
        return True, value if high is None else min(value, high)
    if kind == "rows":
        known = {f"{row.key}/{action}" for row in data.rows for action, _ in row.actions}
        return isinstance(value, str) and value in known, value
    return kind == "dialog", None


def _finite(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
