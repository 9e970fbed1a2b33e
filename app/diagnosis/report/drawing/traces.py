"""Torque of one joint over time: measured, simulated before and after, and what the difference is made of."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from app.diagnosis.report.budget import in_order
from app.diagnosis.report.drawing import svg
from app.diagnosis.report.drawing.axes import Axes, padded
from app.diagnosis.report.drawing.palette import NOISE, colour
from app.diagnosis.report.events import Event
from app.diagnosis.result import Evidence

WIDTH = 680.0
LEFT, RIGHT = 48.0, 12.0
UPPER, LOWER, STACK = 62.0, 36.0, 74.0
GAP = 9.0
#: More columns than this the eye does not tell apart; each is drawn from its lowest to its highest value.
COLUMNS = 420


def trace_plot(
    evidence: Evidence,
    joint: int,
    events: Sequence[Event],
    *,
    labelled: bool,
    width: float = WIDTH,
    at: float | None = None,
) -> str:
    """One joint: torques above, below what the description lacks, on one time axis.

    Where the engine says what each family adds, the lower part is stacked from them: the line is the error of the
    description, the areas add up to it. Else it shows the errors before and after.

    Args:
        joint: counted from 0.
        events: spans of time to shade and number.
        labelled: True writes the time axis.
        at: a moment to mark [s].
    """
    t = evidence.seconds
    assert t is not None
    measured = evidence.measured[:, joint]
    before, after = evidence.before[:, joint], evidence.after[:, joint]
    parts = {family: part[:, joint] for family, part in in_order(evidence.parts).items()}
    span = (float(t[0]), float(t[-1]))
    below = STACK if parts else LOWER
    upper = Axes(LEFT, 20, width - LEFT - RIGHT, UPPER, span, padded(np.r_[measured, measured - before], 0.1))
    lower = Axes(LEFT, 20 + UPPER + GAP, upper.width, below, span, padded(np.r_[before, after], zero=True))
    out = [_shaded(axes, events) for axes in (upper, lower)]
    out.append(upper.frame("", f"{evidence.components[joint]}: torque [Nm]", x_ticks=0))
    if parts:
        lower = Axes(lower.left, lower.top, lower.width, below, span, _heights(t, parts, after, before))
        out.append(_stacked(lower, t, parts, after))
    out.append(
        lower.frame(
            "time [s]" if labelled else "", "", y_ticks=3 if parts else 2, x_ticks=6 if labelled else 0
        )
    )
    searched = not np.array_equal(before, after, equal_nan=True)  # else there is only one simulation to show
    lines = [
        (upper, measured, "trace measured"),
        (upper, measured - before, "trace before"),
        *([(upper, measured - after, "trace after")] if searched else []),
        (lower, before, "trace missed" if parts else "trace before"),
        *([(lower, after, "trace after")] if searched and not parts else []),
    ]
    out += [svg.line(*_thin(axes, t, values), klass) for axes, values, klass in lines]
    out.append(_numbers(upper, events))
    if at is not None:
        x = float(upper.x(at))
        out.append(svg.tag("line", klass="now", x1=x, x2=x, y1=upper.top, y2=lower.top + lower.height))
    height = lower.top + below + (37 if labelled else 7)
    return svg.picture(width, height, out, f"{evidence.components[joint]}: measured and simulated torque")


def _shaded(axes: Axes, events: Sequence[Event]) -> str:
    out = []
    for event in events:
        a, b = np.clip([event.start, event.end], *axes.x_range)
        if b > a:
            x0, x1 = float(axes.x(a)), float(axes.x(b))
            out.append(
                svg.tag("rect", klass="window", x=x0, y=axes.top, width=max(x1 - x0, 1.5), height=axes.height)
            )
    return "".join(out)


def _numbers(axes: Axes, events: Sequence[Event]) -> str:
    """The finding's number where its time begins."""
    out = []
    for event in events:
        if axes.x_range[0] <= event.start <= axes.x_range[1]:
            x = float(axes.x(event.start))
            out.append(svg.tag("circle", klass="flag", cx=x, cy=axes.top + 7, r=7))
            out.append(svg.text(x, axes.top + 10, str(event.number), klass="flag-number mid"))
    return "".join(out)


def _columns(t: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Time and mean of each of at most COLUMNS stretches: areas cannot be drawn from lowest to highest."""
    count = min(len(t), COLUMNS)
    edges = np.linspace(0, len(t), count + 1).astype(int)
    sizes = np.diff(edges)
    values = np.nan_to_num(values)
    return np.add.reduceat(t, edges[:-1]) / sizes, np.add.reduceat(values, edges[:-1]) / sizes


def _heights(
    t: np.ndarray, parts: dict[str, np.ndarray], after: np.ndarray, before: np.ndarray
) -> tuple[float, float]:
    """Range that holds the stack and the line."""
    columns = np.array([_columns(t, p)[1] for p in (*parts.values(), after)])
    up, down = np.clip(columns, 0, None).sum(0), np.clip(columns, None, 0).sum(0)
    return padded(np.r_[up, down, before], zero=True)


def _stacked(axes: Axes, t: np.ndarray, parts: dict[str, np.ndarray], after: np.ndarray) -> str:
    """Areas of the families, what pushes up above zero and what pushes down below it; what is left outermost."""
    up = down = np.zeros(min(len(t), COLUMNS))
    out = []
    for fill, part in [*((colour(f), p) for f, p in parts.items()), (NOISE, after)]:
        x, values = _columns(t, part)
        for sign in (1, -1):
            add = np.clip(values * sign, 0, None) * sign
            low = up if sign > 0 else down
            out.append(svg.area(axes.x(x), axes.y(low), axes.y(low + add), fill))
            up, down = (low + add, down) if sign > 0 else (up, low + add)
    return "".join(out)


def _thin(axes: Axes, t: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Paper coordinates, at most two a column, none of the peaks lost."""
    good = np.isfinite(values) & np.isfinite(t)
    t, values = t[good], values[good]
    if len(t) <= 2 * COLUMNS:
        return axes.x(t), axes.y(values)
    edges = np.linspace(0, len(t), COLUMNS + 1).astype(int)[:-1]
    low, high = np.minimum.reduceat(values, edges), np.maximum.reduceat(values, edges)
    x = np.repeat(axes.x(t[edges]), 2)
    return x, axes.y(np.stack([low, high], 1).ravel())
