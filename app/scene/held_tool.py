"""The tool in the arm's hand: as its drawing says, or, where its truth is to be found, as its picture says.

A tool that is not what the drawing says is the drawing, bent towards the tip that is shown; its seat stays where it
is. On an arm that is not where the controller says, the tool is moved by what the tip is off, in steps of half a
millimetre.
"""

from __future__ import annotations

import itertools
from functools import lru_cache

import numpy as np
import viser

from app.geometry import Pose
from app.kinematics import RobotModel
from app.scene.arm import Bend, Mesh, draw_meshes, merged
from app.simulation.held import held_shapes
from app.simulation.world import World, default_tool
from app.units import from_mm

_STEP = from_mm(0.5)
_NUMBERS = itertools.count(1)


class HeldTool:
    """Drawn on the flange.

    Args:
        scene: the browser's.
        flange_path: scene node of the flange.
        world: whose tool.
    """

    def __init__(self, scene: viser.SceneApi, flange_path: str, world: World):
        nominal, picture = default_tool(world.robot), world.picture
        self.bend = None if picture is None else bent(nominal, picture.T_flange_tool)
        self.path = f"{flange_path}/tool{next(_NUMBERS)}"  # a new name: the page keeps a removed node's pose
        self._frame = draw_meshes(scene, self.path, held_meshes(world.robot), bend=self.bend)
        self._at = np.zeros(3)

    def pose(self, q: np.ndarray, world: World) -> None:
        """The arm stands at q (n,): only where it is not where it says, the drawing moves."""
        if not world.faults or world.picture is None:
            return
        tip = world.picture.T_flange_tool.position
        there = world.shown_flange(q).inverse().apply(world.true_flange(q).apply(tip))
        at = np.round((there - tip) / _STEP) * _STEP
        if not np.array_equal(at, self._at):
            self._at, self._frame.position = at, tuple(at)

    def remove(self) -> None:
        """Takes the drawing away."""
        self._frame.remove()


@lru_cache(maxsize=16)
def held_meshes(robot: RobotModel) -> tuple[Mesh, ...]:
    """The tool in an arm's hand as its drawing says, worked out once for all who hold it."""
    return merged(held_shapes(robot))


def bent(T_flange_nominal: Pose, T_flange_drawn: Pose) -> Bend:
    """What brings the drawing's tip to the one that is shown, more the nearer a point is to the tip.

    The displacement of a point is w (d + (R - I)(v - tip)), w from 0 at the flange to 1 at the tip.
    """
    tip = T_flange_nominal.position
    along = tip / max(float(tip @ tip), 1e-12)
    shift = T_flange_drawn.position - tip
    turn = T_flange_drawn.rotation @ T_flange_nominal.rotation.T - np.eye(3)

    def bend(points: np.ndarray) -> np.ndarray:
        share = np.clip(points @ along, 0.0, 1.0)[:, None]
        return points + share * (shift + (points - tip) @ turn.T)

    return bend
