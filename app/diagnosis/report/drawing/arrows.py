"""Residuals as arrows where they were measured, seen from above and from the side."""

from __future__ import annotations

import numpy as np

from app.diagnosis.report.curves import residual_vectors
from app.diagnosis.report.drawing import svg
from app.diagnosis.report.drawing.axes import Axes
from app.diagnosis.result import Evidence
from app.units import mm

WIDTH, HEIGHT = 330.0, 270.0
MOST_ARROWS = 250
#: An arrow of the size of the 90th percentile is this share of the picture's longer side.
_LENGTH = 0.09


def magnification(evidence: Evidence) -> float:
    """How much longer than life arrows are drawn: a round number, the same before and after."""
    points, residual = _points(evidence), _residual(evidence, after=False)
    good = evidence.kept & np.isfinite(points).all(1) & np.isfinite(residual).all(1)
    if not good.any():
        return 1.0
    spread = float(np.ptp(points[good], axis=0).max()) or 1.0
    size = float(np.quantile(np.linalg.norm(residual[good], axis=1), 0.9)) or 1e-6
    raw = _LENGTH * spread / size
    power = 10.0 ** np.floor(np.log10(raw))
    return max(float(next(s for s in (5, 2, 1) if s * power <= raw * 1.0001) * power), 1.0)


def arrow_plot(evidence: Evidence, view: tuple[int, int], *, after: bool, factor: float, title: str) -> str:
    """One projection.

    Args:
        view: which coordinates go right and up: (0, 1) from above, (0, 2) from the side.
        after: with the findings in the model.
        factor: how much longer than life.
    """
    points, residual = _points(evidence), _residual(evidence, after=after)
    good = np.flatnonzero(np.isfinite(points).all(1) & np.isfinite(residual).all(1))
    if len(good) > MOST_ARROWS:
        good = good[np.linspace(0, len(good) - 1, MOST_ARROWS).astype(int)]
    tail, head = mm(points[good][:, view]), mm((points + factor * residual)[good][:, view])
    kept = evidence.kept[good]
    axes = _square(mm(points[good][:, view]))
    names = ("x", "y", "z")
    arrows = [
        _heads(axes, tail[~kept], head[~kept], "stroke aside"),
        _heads(axes, tail[kept], head[kept], "stroke after" if after else "stroke before"),
        svg.dots(axes.x(tail[:, 0]), axes.y(tail[:, 1]), "dot place"),
    ]
    clip, clipped = svg.clipped(axes.left, axes.top, axes.width, axes.height, arrows)
    out = [
        clip,
        axes.frame(f"{names[view[0]]} of base [mm]", f"{title}: {names[view[1]]} of base [mm]"),
        clipped,
    ]
    return svg.picture(WIDTH, HEIGHT, out, f"{title}, residual arrows, {factor:g} times life size")


def _points(evidence: Evidence) -> np.ndarray:
    assert evidence.points_predicted_before is not None
    return evidence.points_predicted_before


def _residual(evidence: Evidence, *, after: bool) -> np.ndarray:
    vectors = residual_vectors(evidence)[int(after)]
    assert vectors is not None
    return vectors


def _square(points: np.ndarray) -> Axes:
    """Axes with the same scale both ways that hold the points."""
    left, top, width, height = 48.0, 22.0, WIDTH - 60.0, HEIGHT - 58.0
    low, high = points.min(0), points.max(0)
    middle, span = (low + high) / 2, np.maximum(high - low, 1e-6) * 1.25
    scale = max(span[0] / width, span[1] / height)
    half = np.array([width, height]) * scale / 2
    return Axes(
        left,
        top,
        width,
        height,
        (float(middle[0] - half[0]), float(middle[0] + half[0])),
        (float(middle[1] - half[1]), float(middle[1] + half[1])),
    )


def _heads(axes: Axes, tail: np.ndarray, head: np.ndarray, klass: str) -> str:
    """Shafts with two barbs; too short an arrow gets none."""
    x0, y0, x1, y1 = axes.x(tail[:, 0]), axes.y(tail[:, 1]), axes.x(head[:, 0]), axes.y(head[:, 1])
    out = [svg.segments(x0, y0, x1, y1, klass)]
    dx, dy = x1 - x0, y1 - y0
    length = np.hypot(dx, dy)
    long = length > 3.0
    barb = np.minimum(4.0, 0.4 * length[long]) / length[long]
    for turn in (0.45, -0.45):
        c, s = np.cos(turn), np.sin(turn)
        bx = (dx[long] * c - dy[long] * s) * barb
        by = (dx[long] * s + dy[long] * c) * barb
        out.append(svg.segments(x1[long], y1[long], x1[long] - bx, y1[long] - by, klass))
    return "".join(out)
