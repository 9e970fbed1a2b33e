"""The shapes of the tool in an arm's hand."""

from __future__ import annotations

import numpy as np

from app.geometry import Pose
from app.kinematics import RobotModel
from app.kinematics.shapes import Shape, rod
from app.kinematics.solids import tool_shapes
from app.simulation.world import default_tool


def held_shapes(robot: RobotModel) -> tuple[Shape, ...]:
    """The tool of an arm by its description, else a plain pointer."""
    return tuple(tool_shapes(robot)) if "tool" in robot.description else pointer_shapes(default_tool(robot))


def pointer_shapes(T_flange_tool: Pose) -> tuple[Shape, ...]:
    """A plain pointer from the flange to a tool point, for tools that have no drawing of their own."""
    tip = T_flange_tool.position
    length = float(np.linalg.norm(tip))
    if length < 1e-4:
        return ()
    radius = min(0.02, 0.12 * length)
    neck = tip * max(0.55, 1.0 - 0.08 / length)
    steel, dark = (0.72, 0.74, 0.76), (0.16, 0.17, 0.19)
    return (
        rod(np.zeros(3), neck, radius, 0.7 * radius, link="tool", colour=dark),
        rod(neck, tip, 0.6 * radius, 0.0, link="tool tip", colour=steel),
    )
