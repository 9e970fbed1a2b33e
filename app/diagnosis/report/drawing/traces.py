"""Torque of one joint over time: measured, simulated before and after, and what is left; contacts shaded."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from app.diagnosis.report.drawing import svg
from app.diagnosis.report.drawing.axes import Axes, padded
from app.diagnosis.result import Evidence

WIDTH, HEIGHT = 680.0, 148.0
LEFT, RIGHT = 48.0, 12.0
UPPER, LOWER = 62.0, 36.0
#: More columns than this the eye does not tell apart; each is drawn from its lowest to its highest value.
COLUMNS = 420


def trace_plot(
    evidence: Evidence,
    joint: int,
    windows: Sequence[tuple[float, float]],
    *,
    labelled: bool,
    width: float = WIDTH,
    at: float | None = None,
) -> str:
    """One joint: torques above, residuals below, on one time axis.

    Args:
        joint: counted from 0.
        windows: spans of time to shade [s].
        labelled: True writes the time axis.
        at: a moment to mark [s].
    """
    t = evidence.seconds
    assert t is not None
    measured = evidence.measured[:, joint]
    before, after = evidence.before[:, joint], evidence.after[:, joint]
    span = (float(t[0]), float(t[-1]))
    upper = Axes(LEFT, 20, width - LEFT - RIGHT, UPPER, span, padded(np.r_[measured, measured - before], 0.1))
    lower = Axes(LEFT, 20 + UPPER + 9, upper.width, LOWER, span, padded(np.r_[before, after], zero=True))
    out = []
    for axes in (upper, lower):
        for start, end in windows:
            a, b = np.clip([start, end], *span)
            if b > a:
                x0, x1 = float(axes.x(a)), float(axes.x(b))
                out.append(
                    svg.tag(
                        "rect", klass="window", x=x0, y=axes.top, width=max(x1 - x0, 1.5), height=axes.height
                    )
                )
    out.append(upper.frame("", f"{evidence.components[joint]}: torque [Nm]", x_ticks=0))
    out.append(lower.frame("time [s]" if labelled else "", "", y_ticks=2, x_ticks=6 if labelled else 0))
    searched = not np.array_equal(before, after, equal_nan=True)  # else there is only one simulation to show
    lines = [
        (upper, measured, "trace measured"),
        (upper, measured - before, "trace before"),
        (upper, measured - after, "trace after"),
        (lower, before, "trace before"),
        (lower, after, "trace after"),
    ]
    for axes, values, klass in lines:
        if klass == "trace after" and not searched:
            continue
        out.append(svg.line(*_thin(axes, t, values), klass))
    if at is not None:
        x = float(upper.x(at))
        out.append(svg.tag("line", klass="now", x1=x, x2=x, y1=upper.top, y2=lower.top + lower.height))
    height = HEIGHT + (16 if labelled else -14)
    return svg.picture(width, height, out, f"{evidence.components[joint]}: measured and simulated torque")


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
