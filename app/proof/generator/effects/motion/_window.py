"""When something begins and ends."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from app.errors import InputError


def start_time(rng: np.random.Generator, cell: Any, asked: Mapping[str, Any], effect: str) -> float:
    """A time between a fifth and four fifths of the log, or the one asked for."""
    first, last = float(cell.t[0]), float(cell.t[-1])
    drawn = float(first + rng.uniform(0.2, 0.75) * (last - first))
    return _inside(asked.get("from_s", round(drawn, 2)), first, last, effect, "from_s")


def end_time(
    rng: np.random.Generator, cell: Any, asked: Mapping[str, Any], start: float, effect: str
) -> float:
    """Some time after the start: 4% to 12% of the log."""
    last = float(cell.t[-1])
    drawn = start + float(rng.uniform(0.04, 0.12)) * (last - float(cell.t[0]))
    return _inside(asked.get("to_s", round(min(drawn, last), 2)), start, last, effect, "to_s")


def within(cell: Any, where: Mapping[str, Any]) -> np.ndarray:
    """(m,) 1.0 from `from_s` on and before `to_s`."""
    inside = (cell.t >= where["from_s"]) & (cell.t < where.get("to_s", np.inf))
    return inside.astype(float)


def _inside(value: float, first: float, last: float, effect: str, key: str) -> float:
    if not first <= value <= last:
        raise InputError(f"effect {effect}: {key}={value:g}", expected=f"{first:.2f} to {last:.2f} s")
    return value
