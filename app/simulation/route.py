"""A way that hits nothing: straight, or backing off from what the tool is at, or over home."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from app.geometry import Pose
from app.kinematics import solve_ik
from app.simulation.guard import Guard, Stop
from app.simulation.world import World
from app.units import from_mm

#: How far the tool backs off, as shares of the arm's reach: along its own axis, and upwards.
_BACK, _UP = 0.06, 0.12
#: How far before a place the tip may stop, along the tool [m].
_SHORT = (from_mm(10.0), from_mm(20.0), from_mm(40.0))


def route(world: World, guard: Guard, start: np.ndarray, end: np.ndarray) -> list[np.ndarray] | Stop:
    """Poses to go through from start to end (n,) [rad or m], the last one `end`; or what is in the straight way."""
    straight = guard.free(start, end)
    if straight is None:
        return [end]
    for through in _ways_round(world, start, end):
        stops = [start, *through, end]
        if all(guard.free(a, b) is None for a, b in pairwise(stops)):
            return stops[1:]
    return straight


def short_of(world: World, guard: Guard, start: np.ndarray, end: np.ndarray) -> np.ndarray | None:
    """A pose just before `end` to which a way is free, where the tip would press at `end` (n,); None where none is.

    A place that was worked out for another tool than the one that is there may lie within the spike.
    """
    straight = route(world, guard, start, end)
    if not isinstance(straight, Stop) or straight.kind == "hit":
        return None
    for length in _SHORT:
        before = _shifted(world, end, "tool", -length)
        if before is not None and not isinstance(route(world, guard, start, before), Stop):
            return before
    return None


def _ways_round(world: World, start: np.ndarray, end: np.ndarray) -> Iterator[list[np.ndarray]]:
    reach = float(world.robot.description.get("reach_m", world.robot.reach))
    for axes, length in (("tool", -_BACK * reach), ("base", _UP * reach)):
        left, before = (_shifted(world, q, axes, length) for q in (start, end))
        for through in ((left, before), (left,), (before,)):
            if all(q is not None for q in through):
                yield [q for q in through if q is not None]
        if left is not None and before is not None:
            yield [left, world.robot.home, before]
    yield [world.robot.home]


def _shifted(world: World, q: np.ndarray, axes: str, length: float) -> np.ndarray | None:
    tip = world.hand(q)
    direction = tip.rotation[:, 2] if axes == "tool" else np.array([0.0, 0.0, 1.0])
    aim = Pose.of(tip.rotation, tip.position + length * direction)
    found = solve_ik(world.robot, aim, q, T_flange_tool=world.T_flange_tool_hand, explain=False)
    return found.q if found.reached else None
