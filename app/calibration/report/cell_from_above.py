"""Both bases, the tracker and every measured point from above, as SVG text: how the cell stands."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from app.calibration.base.relation import Relation
from app.calibration.base.result import BaseCalibration
from app.calibration.report.pictures import INK, SOFT, TIP, Words, line, text
from app.geometry import Pose
from app.units import from_mm

_MARGIN, _LOW = 22.0, 16.0  # px; room for the caption below
_AXIS = 0.22  # length of a drawn axis, as a share of the cell
_BAR = from_mm(1000.0)  # m of the scale
_COLOURS = ("#2a62b8", "#2e8b57")  # of the two robots' points


def cell_from_above(
    bases: Sequence[BaseCalibration], relation: Relation, words: Words, width: int = 330, height: int = 210
) -> str:
    """Seen along -Z of base 1, X to the right.

    Args:
        bases: both robots.
        relation: with T_base1_base2.
        words: gives the labels.
    """
    second = relation.T_base1_base2
    assert second is not None
    frames = (Pose.identity(), second)
    # What each recording says stands in its own tracker frame: the tracker may have been moved in between.
    clouds = [
        (frame @ base.T_tracker_base.inverse()).apply(np.vstack([a.arc.points for a in base.arcs]))
        for frame, base in zip(frames, bases, strict=True)
    ]
    tracker = bases[0].T_tracker_base.inverse().position
    stands = np.array([frame.position for frame in frames])
    everything = np.vstack([*clouds, tracker, stands, relation.meeting])[:, :2]
    low, high = everything.min(axis=0), everything.max(axis=0)
    room = np.array([width - 2 * _MARGIN, height - 2 * _MARGIN - _LOW])
    scale = float((room / np.maximum(high - low, 1e-3)).min())
    offset = (np.array([width, height - _LOW]) - scale * (high - low)) / 2

    def place(point: np.ndarray) -> np.ndarray:
        flat = offset + scale * (np.asarray(point)[:2] - low)
        return np.array([flat[0], height - _LOW - flat[1]])

    parts = [f'<svg viewBox="0 0 {width} {height}" role="img" aria-label="{words("picture_cell")}">']
    for cloud, colour in zip(clouds, _COLOURS, strict=True):
        for point in cloud:
            x, y = place(point)
            parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="1.6" fill="{colour}" fill-opacity="0.7"/>')
    length = _AXIS * float((high - low).max())
    for number, frame in enumerate(frames, 1):
        at = place(frame.position)
        for column, name in enumerate("XY"):
            end = place(frame.position + length * frame.rotation[:, column])
            parts.append(line(at, end, INK, 1.6, 0.8))
            parts.append(text(end[0] + 3, end[1] + 3, name, INK, 9))
        parts.append(f'<circle cx="{at[0]:.1f}" cy="{at[1]:.1f}" r="8" fill="{_COLOURS[number - 1]}"/>')
        parts.append(text(at[0], at[1] + 3.5, str(number), "white", 10, "middle"))
    x, y = place(tracker)
    parts.append(f'<rect x="{x - 5:.1f}" y="{y - 5:.1f}" width="10" height="10" fill="{SOFT}"/>')
    parts.append(text(x, y - 8, words("picture_tracker"), INK, 9, "middle"))
    x, y = place(relation.meeting)
    parts.append(line(np.array([x - 5, y]), np.array([x + 5, y]), TIP, 1.6, 1.0))
    parts.append(line(np.array([x, y - 5]), np.array([x, y + 5]), TIP, 1.6, 1.0))
    foot = height - _LOW - 2.0
    parts.append(line(np.array([8.0, foot]), np.array([8.0 + scale * _BAR, foot]), INK, 1.6, 1.0))
    parts.append(text(8, foot - 4, "1 m", INK, 9))
    parts.append(text(width / 2, height - 3, words("picture_cell"), SOFT, 10, "middle"))
    return "".join(parts) + "</svg>"
