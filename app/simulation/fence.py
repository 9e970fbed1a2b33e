"""The fence: posts and wires behind the arm and on its left, to be seen through and not to be passed."""

from __future__ import annotations

import numpy as np

from app.geometry import Pose
from app.kinematics.shapes import Shape, rod
from app.simulation.world import World
from app.units import from_mm

_POST, _WIRE, _THICK = from_mm(20.0), from_mm(3.5), from_mm(30.0)
_YELLOW, _GREY = (0.90, 0.74, 0.28), (0.66, 0.69, 0.72)
#: Of the reach: how far behind the arm, how far beside it, how far forward the side goes, and how high.
_BEHIND, _BESIDE, _FORWARD, _HEIGHT = 0.80, 1.02, 0.95, 0.75
_WIRES = 6
_POSTS = 3  # spans of a side


def _corners(world: World) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, float]:
    """Ends of the back (right, left), the front end of the side [m], up, and the height [m]."""
    reach = float(world.robot.description.get("reach_m", world.robot.reach))
    towards = world.p_base_spike_drawn[:2]
    ahead = np.array([*(towards / max(float(np.linalg.norm(towards)), 1e-9)), 0.0])
    left = np.array([-ahead[1], ahead[0], 0.0])
    back = -_BEHIND * reach * ahead
    return (
        back - _BESIDE * reach * left,
        back + _BESIDE * reach * left,
        _FORWARD * reach * ahead + _BESIDE * reach * left,
        np.array([0.0, 0.0, 1.0]),
        _HEIGHT * reach,
    )


def fence_shapes(world: World) -> tuple[Shape, ...]:
    """What is drawn: posts with wires between them."""
    right, corner, front, up, height = _corners(world)
    shapes = []
    for start, end in ((right, corner), (corner, front)):
        for k in range(_POSTS + 1):
            foot = start + (end - start) * (k / _POSTS)
            shapes.append(rod(foot, foot + height * up, _POST, link="fence", colour=_YELLOW))
        for k in range(1, _WIRES + 1):
            level = height * k / _WIRES * up
            shapes.append(rod(start + level, end + level, _WIRE, link="fence", colour=_GREY))
    return tuple(shapes)


def fence_panels(world: World) -> tuple[Shape, ...]:
    """What is hit: a closed panel a side."""
    right, corner, front, up, height = _corners(world)
    panels = []
    for start, end in ((right, corner), (corner, front)):
        along = (end - start) / np.linalg.norm(end - start)
        pose = Pose.of(np.stack([along, np.cross(up, along), up], axis=1), (start + end + height * up) / 2)
        size = (float(np.linalg.norm(end - start)), _THICK, height)
        panels.append(Shape(0, "fence", "box", size, pose))
    return tuple(panels)
