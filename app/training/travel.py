"""How far the tip went, and how near arm and tool came to what they must not touch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.geometry import Pose
from app.simulation.tracker import segment_distance
from app.simulation.world import World
from app.units import from_mm

#: Nearer than this is a near miss [m].
NEAR = from_mm(10.0)
_TOOL = from_mm(15.0)  # radius of the tool's body, and of the wrist
_WRIST = from_mm(60.0)
_SHARP = from_mm(80.0)  # the sharpened ends of tool and spike are meant to meet
_ROD = from_mm(9.0)
_TABLE = from_mm(310.0)  # half its edge


@dataclass(frozen=True)
class Travel:
    """What the way of an arm amounts to.

    Args:
        length: of the tip's way [m].
        near: how often something came nearer than NEAR.
        closest: least distance [m] to table or spike, below zero where a body would have gone into it.
    """

    length: float
    near: int
    closest: float


def travel(world: World, way: np.ndarray) -> Travel:
    """Looks at every pose of a way (k, n): tool and wrist as rods, the table as a plate, the spike as a rod."""
    frames = world.robot.chain.frames(way)
    tool = world.T_flange_tool_true.position
    flange = frames.flange_positions
    tips = flange + frames.flange_rotations @ tool
    length = float(np.linalg.norm(np.diff(tips, axis=0), axis=1).sum())
    body = flange + (tips - flange) * max(0.0, 1.0 - _SHARP / max(float(np.linalg.norm(tool)), 1e-9))
    wrist = frames.joint_positions[:, -2]
    spike, top = world.p_base_spike_drawn, world.table_height
    foot, shoulder = np.array([*spike[:2], top]), spike - np.array([0.0, 0.0, _SHARP])
    gaps = np.array(
        [
            min(
                segment_distance(body[k], flange[k], foot, shoulder) - _TOOL - _ROD,
                segment_distance(flange[k], wrist[k], foot, spike) - _WRIST - _ROD,
                _above(tips[k], spike, top),
                _above(body[k], spike, top) - _TOOL,
                _above(wrist[k], spike, top) - _WRIST,
            )
            for k in range(len(way))
        ]
    )
    close = gaps < NEAR
    count = int(close[0]) + int(np.sum(close[1:] & ~close[:-1]))
    return Travel(length, count, float(gaps.min()))


def _above(point: np.ndarray, spike: np.ndarray, top: float) -> float:
    """Height of a point above the table [m]; infinite beside it."""
    return float(point[2] - top) if np.abs(point[:2] - spike[:2]).max() < _TABLE else np.inf


def off(a: Pose, b: Pose) -> tuple[float, float]:
    """Distance [m] and angle [rad] between two poses."""
    gap = a.inverse() @ b
    return float(np.linalg.norm(gap.position)), float(np.linalg.norm(gap.rotvec))
