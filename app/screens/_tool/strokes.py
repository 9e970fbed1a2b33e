"""Whether strokes can be made from a pose: along each axis of the tool, or back along it."""

from __future__ import annotations

import numpy as np

from app.geometry import Pose
from app.kinematics import solve_ik
from app.session.motion.guarding import guard_of
from app.simulation.world import World, default_tool
from app.units import from_mm

_LENGTH = from_mm(150.0)


def strokes_free(world: World, q: np.ndarray, axes: tuple[int, ...]) -> bool:
    """True where from q (n,) a stroke along every axis is within reach and hits nothing, in one sense at least.

    By the tool as the description has it: that is all anybody knows before the tool is taught.
    """
    tool = default_tool(world.robot)
    start = world.robot.forward(q) @ tool
    guard = guard_of(world)
    for axis in axes:
        for sense in (1.0, -1.0):
            aim = Pose.of(start.rotation, start.position + sense * _LENGTH * start.rotation[:, axis])
            found = solve_ik(world.robot, aim, q, T_flange_tool=tool, max_steps=100, explain=False)
            if found.reached and guard.free(q, found.q) is None:
                break
        else:
            return False
    return True
