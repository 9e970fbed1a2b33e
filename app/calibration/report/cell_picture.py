"""The arm and the recorded points from the side, as SVG text: where everything stood while it was taught."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from app.calibration.captures import Capture
from app.calibration.report.pictures import INK, SOFT, TIP, Words, line, text
from app.calibration.result import ToolCalibration
from app.kinematics import RobotModel

_MARGIN = 16.0
_LOW = 14.0  # room for the caption


def cell_picture(
    result: ToolCalibration,
    captures: Sequence[Capture],
    robot: RobotModel | None,
    words: Words,
    width: int = 210,
    height: int = 190,
) -> str:
    """Flanges with their tools, the tips, and, where joints were recorded, the arm's axes at the first point.

    Seen square to the plane through the base's Z and the middle of the tips.
    """
    if not captures:
        return ""
    flanges = np.array([c.T_base_flange.position for c in captures])
    tips = np.array([c.T_base_flange.apply(result.tool_point) for c in captures])
    ahead = np.array([*tips.mean(axis=0)[:2], 0.0])
    length = float(np.linalg.norm(ahead))
    ahead = ahead / length if length > 1e-6 else np.array([1.0, 0.0, 0.0])
    view = np.stack([ahead, [0.0, 0.0, 1.0]])  # (2, 3)
    arm = _axes(robot, captures)
    everything = np.concatenate([flanges, tips, arm, np.zeros((1, 3))]) @ view.T
    low, high = everything.min(axis=0), everything.max(axis=0)
    room = np.array([width - 2 * _MARGIN, height - 2 * _MARGIN - _LOW])
    scale = float((room / np.maximum(high - low, 1e-3)).min())
    offset = (np.array([width, height - _LOW]) - scale * (high - low)) / 2

    def place(point: np.ndarray) -> np.ndarray:
        flat = offset + scale * (view @ point - low)
        return np.array([flat[0], height - _LOW - flat[1]])

    parts = [f'<svg viewBox="0 0 {width} {height}" role="img" aria-label="{words("picture_cell")}">']
    base = place(np.zeros(3))
    foot = np.array([12.0, 0.0])
    parts.append(line(base - foot, base + foot, SOFT, 3.0, 0.8))
    bones = [place(point) for point in arm]
    parts += [line(a, b, SOFT, 5.0, 0.6) for a, b in pairwise(bones)]
    parts += [line(place(f), place(t), INK, 1.6, 0.55) for f, t in zip(flanges, tips, strict=True)]
    for number, flange in enumerate(flanges, 1):
        x, y = place(flange)
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="5.5" fill="{INK}"/>')
        parts.append(text(x, y + 2.6, str(number), "white", 8, "middle"))
    for tip in tips:
        x, y = place(tip)
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.2" fill="{TIP}"/>')
    parts.append(text(width / 2, height - 3, words("picture_cell"), SOFT, 10, "middle"))
    return "".join(parts) + "</svg>"


def _axes(robot: RobotModel | None, captures: Sequence[Capture]) -> np.ndarray:
    """(n, 3) base, places of the joints and flange at the first point whose joints are known; (0, 3) without."""
    known = next((c.q for c in captures if c.q is not None), None)
    if robot is None or known is None or len(known) != robot.joint_count:
        return np.zeros((0, 3))
    frames = robot.chain.frames(np.asarray(known)[None])
    return np.concatenate([np.zeros((1, 3)), frames.joint_positions[0], frames.flange_positions])
