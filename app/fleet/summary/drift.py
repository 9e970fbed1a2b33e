"""What changes in an arm over months: a straight line through the values of an effect, weighted by their errors."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from scipy import stats

from app.fleet.summary.seen import Seen, Value, What

MONTH = 365.25 / 12 * 86400.0  # seconds
#: Fewer recordings, or a shorter time, tell no course.
LEAST, SHORTEST = 4, MONTH
#: Chance that anything in the whole list is no drift, all series counted (Holm).
CHANCE = 0.01


@dataclass(frozen=True)
class Drift:
    """A value that changes.

    Args:
        arm, what, name: which.
        first, last: times of the first and last recording [s since 1970].
        count: recordings.
        slope: change a month with its standard error, in the value's unit.
        start, end: the line at the first and the last recording.
        points: (time, value, standard error) of each.
        p_value: of the slope, alone.
    """

    arm: str
    what: What
    name: str
    first: float
    last: float
    count: int
    slope: Value
    start: float
    end: float
    points: tuple[tuple[float, float, float], ...]
    p_value: float


def drifts(all_seen: Iterable[Seen]) -> tuple[list[Drift], int]:
    """Drifts that are no chance, the surest first, and how many series were long enough to be looked at."""
    series: dict[tuple[str, What, str], list[tuple[float, Value]]] = {}
    for one in all_seen:
        for what, values in one.found.items():
            for value in values:
                series.setdefault((one.arm, what, value.name), []).append((one.recorded, value))
    lines = []
    for (arm, what, name), points in series.items():
        line = _line(arm, what, name, sorted(points, key=lambda p: p[0]))
        if line is not None:
            lines.append(line)
    lines.sort(key=lambda d: d.p_value)
    sure = 0
    while sure < len(lines) and lines[sure].p_value <= CHANCE / (len(lines) - sure):
        sure += 1
    return lines[:sure], len(lines)


def _line(arm: str, what: What, name: str, points: list[tuple[float, Value]]) -> Drift | None:
    usable = [(t, v) for t, v in points if v.std > 0 and math.isfinite(v.std) and math.isfinite(v.value)]
    if len(usable) < LEAST or usable[-1][0] - usable[0][0] < SHORTEST:
        return None
    t = np.array([when for when, _ in usable])
    y, s = (np.array([getattr(v, part) for _, v in usable]) for part in ("value", "std"))
    x, w = (t - t.mean()) / MONTH, 1.0 / s**2
    design = np.stack([np.ones_like(x), x], axis=1)  # (n, 2)
    normal = design.T @ (w[:, None] * design)
    level, slope = np.linalg.solve(normal, design.T @ (w * y))
    free = len(usable) - 2
    # Where recordings of one arm differ by more than their errors say, their own scatter counts.
    scatter = max(1.0, float(w @ (y - level - slope * x) ** 2) / free)
    std = math.sqrt(scatter * np.linalg.inv(normal)[1, 1])
    p = float(2 * stats.t.sf(abs(slope) / std, free))
    unit = usable[0][1].unit
    return Drift(
        arm=arm,
        what=what,
        name=name,
        first=float(t[0]),
        last=float(t[-1]),
        count=len(usable),
        slope=Value(name, float(slope), std, unit),
        start=float(level + slope * x[0]),
        end=float(level + slope * x[-1]),
        points=tuple(zip(t.tolist(), y.tolist(), s.tolist(), strict=True)),
        p_value=p,
    )
