"""Residual against one driver, before and after, with the mean of each bin drawn through."""

from __future__ import annotations

import numpy as np

from app.diagnosis.report.curves import Curve
from app.diagnosis.report.drawing import svg
from app.diagnosis.report.drawing.axes import Axes, padded

WIDTH, HEIGHT = 330.0, 210.0
MOST_DOTS = 700


def driver_plot(curve: Curve) -> str:
    """One panel; before in orange behind, after in blue in front."""
    keep = np.unique(np.linspace(0, len(curve.x) - 1, min(len(curve.x), MOST_DOTS)).astype(int))
    both = np.concatenate([curve.before, curve.after])
    low, high = np.quantile(both, [0.004, 0.996])
    axes = Axes(
        left=48,
        top=22,
        width=WIDTH - 60,
        height=HEIGHT - 58,
        x_range=padded(curve.x, 0.03),
        y_range=padded(np.array([low, high]), 0.08, zero=True),
    )
    searched = not np.array_equal(curve.before, curve.after)  # else there is only one state to show
    inside = [
        svg.dots(axes.x(curve.x[keep]), axes.y(curve.before[keep]), "dot before"),
        svg.dots(axes.x(curve.x[keep]), axes.y(curve.after[keep]), "dot after") if searched else "",
        svg.line(axes.x(curve.centres), axes.y(curve.mean_before), "halo"),
        svg.line(axes.x(curve.centres), axes.y(curve.mean_before), "mean before"),
    ]
    if searched:
        inside += [
            svg.line(axes.x(curve.centres), axes.y(curve.mean_after), "halo"),
            svg.line(axes.x(curve.centres), axes.y(curve.mean_after), "mean after"),
        ]
    clip, clipped = svg.clipped(axes.left, axes.top, axes.width, axes.height, inside)
    return svg.picture(
        WIDTH,
        HEIGHT,
        [clip, axes.frame(curve.driver, curve.response), clipped],
        f"{curve.response} against {curve.driver}",
    )
