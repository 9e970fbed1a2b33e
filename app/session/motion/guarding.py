"""The guard of a cell, and what it says."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from app.kinematics import RobotModel
from app.simulation.cell_shapes import cell_obstacles
from app.simulation.guard import Bodies, Guard, Stop
from app.simulation.held import held_shapes
from app.simulation.world import World
from app.texts import has_text


def guard_of(world: World) -> Guard:
    """A guard of its own for one pendant; the bodies are shared by all who work in such a cell."""
    return Guard(world, _bodies(world.robot, _Cell(world)))


def hit(world: World, q: np.ndarray) -> Stop | None:
    """What is nearer than any way may bring the arm when it stands at q (n,); from any thread."""
    pair = next(iter(_bodies(world.robot, _Cell(world)).touching(q)), None)
    return None if pair is None else Stop("hit", q, *pair)


class _Cell:
    """A world as far as its obstacles go: equal where they stand in the same places."""

    def __init__(self, world: World):
        self.world = world
        self._key = (tuple(world.p_base_spike_drawn), world.table_height)

    def __hash__(self) -> int:
        return hash(self._key)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Cell) and self._key == other._key


@lru_cache(maxsize=32)
def _bodies(robot: RobotModel, cell: _Cell) -> Bodies:
    return Bodies(robot, held_shapes(robot), cell_obstacles(cell.world))


def words(stop: Stop, t: Callable[..., str], language: str) -> str:
    """What stopped the arm, for the operator."""
    if stop.kind == "touch":
        return t("message.felt")
    if stop.kind == "press":
        return t("message.pressed")
    return t("message.hit", a=body(stop.a, t, language), b=body(stop.b, t, language))


def body(name: str, t: Callable[..., str], language: str) -> str:
    """A body's name in the operator's language; the description's own where no language has it."""
    key = f"body.{name.replace(' ', '_')}"
    return t(key) if has_text(key, language) else name
