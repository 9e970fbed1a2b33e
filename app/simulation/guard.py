"""Lets an arm move only as far as nothing is hit: itself, its tool, the table, the spike, the fence.

What already touches may be left: a way is refused only where something comes nearer than it was. Bodies that stand
inside each other, as no guarded way brings them, keep nobody from leaving.
"""

from __future__ import annotations

import threading
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from app.kinematics import CollisionWorld, RobotModel
from app.kinematics.shapes import Shape
from app.simulation.feeling import Feeling
from app.simulation.world import World
from app.units import from_mm

MARGIN = from_mm(2.0)  # bodies this near stop the arm: before they touch
_STEP = from_mm(8.0)  # no point of the arm moves further than this between two looks
_HALVINGS = 5
_AT_THE_END = 3.0  # contact distances the tip may be off when a way counts as having come to its touch
_WORSE = from_mm(0.05)  # a pair that touches may come this much nearer by rounding
_TOOL = 0.3  # m beyond the flange that a joint moves at least


@dataclass(frozen=True, eq=False)
class Bodies:
    """An arm in its cell, shared by all who work in such a cell; one asks at a time."""

    robot: RobotModel
    held: tuple[Shape, ...]
    obstacles: tuple[Shape, ...]
    lock: threading.Lock = field(default_factory=threading.Lock)

    def __post_init__(self):
        world = CollisionWorld(self.robot, tool_shapes=self.held, obstacles=self.obstacles, margin=MARGIN)
        object.__setattr__(self, "_world", world)

    def touching(self, q: np.ndarray) -> dict[tuple[str, str], float]:
        """Pairs nearer than the margin at q (n,), with their distance [m]; the nearest first."""
        with self.lock:
            return {(pair.a, pair.b): pair.distance for pair in self._world.check(q)}  # type: ignore[attr-defined]


@dataclass(frozen=True, eq=False)
class Stop:
    """Why a way ends.

    Args:
        kind: "hit": a and b would touch; "touch": the tip is on the spike; "press": it is beside its point.
        q: (n,) where the arm stands then.
        a, b: the bodies, by the names of the description.
    """

    kind: Literal["hit", "touch", "press"]
    q: np.ndarray
    a: str = "tool tip"
    b: str = "spike"


class Guard:
    """Watches one arm.

    Args:
        world: what is true in the cell.
        bodies: what can be hit in it.
        feeling: of tip and spike there; one of its own unless given.
    """

    def __init__(self, world: World, bodies: Bodies, feeling: Feeling | None = None):
        self.world, self._bodies = world, bodies
        self._feeling = feeling or Feeling(world, bodies.held, bodies.obstacles)
        self._levers = _levers(world.robot, float(np.linalg.norm(world.T_flange_tool_true.position)))
        self._looked: tuple[np.ndarray, dict[tuple[str, str], float]] | None = None  # the pose looked at last

    def advance(
        self, start: np.ndarray, end: np.ndarray, *, feel: bool = True
    ) -> tuple[np.ndarray, Stop | None]:
        """As far as the arm gets on the straight joint way from start to end (n,) [rad or m], and what stops it.

        Args:
            feel: whether tip and spike stop it too; the same object must then be told of every motion in turn.
        """
        start, end = np.asarray(start, float), np.asarray(end, float)
        way = float(np.abs(end - start) @ self._levers)
        if way == 0.0:
            return end, None
        allowed = self._touching(start)  # where the way before ended: looked at once
        pieces = max(1, int(np.ceil(way / _STEP)))
        at = start
        for k in range(1, pieces + 1):
            there = start + (end - start) * (k / pieces) if k < pieces else end
            if feel:
                share, felt = self._feeling.along(at, there, way / pieces)
                if felt:
                    at = at + (there - at) * share
                    return at, Stop(felt, at)
            hit = self._worse(there, allowed)
            if hit is not None:
                for _ in range(_HALVINGS):
                    middle = (at + there) / 2
                    nearer = self._worse(middle, allowed)
                    at, there, hit = (middle, there, hit) if nearer is None else (at, middle, nearer)
                return at, Stop("hit", at, *hit)
            at = there
        return end, None

    def free(self, start: np.ndarray, end: np.ndarray) -> Stop | None:
        """What is in the way from start to end, other than that the tip ends on the spike; None where nothing is."""
        watch = Guard(self.world, self._bodies, self._feeling.again())
        watch._feeling.leave(start)
        at, stop = watch.advance(start, end)
        world = self.world
        if stop is None or stop.kind == "hit" or not world.touching(end):
            return stop
        rest = [world.tip(at + (end - at) * share).position for share in np.linspace(0.0, 0.9, 6)]
        off = np.linalg.norm(rest - world.tip(end).position, axis=1).max()
        return None if off <= _AT_THE_END * world.contact_distance else stop

    def _touching(self, q: np.ndarray) -> dict[tuple[str, str], float]:
        if self._looked is None or not np.array_equal(self._looked[0], q):
            self._looked = q.copy(), self._bodies.touching(q)
        return self._looked[1]

    def _worse(self, q: np.ndarray, allowed: dict[tuple[str, str], float]) -> tuple[str, str] | None:
        for pair, distance in self._touching(q).items():
            before = allowed.get(pair, np.inf)
            if before > -MARGIN and distance < before - _WORSE:
                return pair
        return None


def _levers(robot: RobotModel, tool: float) -> np.ndarray:
    """(n,) how far a point of the arm moves at most for one radian (or metre) of each joint [m]."""
    chain = robot.chain
    lengths = np.linalg.norm(np.vstack([chain.translations[1:], chain.flange_translation]), axis=1)
    beyond = np.cumsum(lengths[::-1])[::-1] + max(tool, _TOOL)
    return np.where(chain.prismatic, 1.0, beyond)
