"""Bodies that meet, coloured: green where the tip is on the spike, red where the guard stopped the arm."""

from __future__ import annotations

import itertools
from typing import Literal

import numpy as np
import viser

from app.kinematics.solids import Solid, faces, robot_solids, solids
from app.scene.arm import ArmView
from app.scene.held_tool import HeldTool
from app.simulation.cell_shapes import cell_obstacles
from app.simulation.held import held_shapes
from app.simulation.world import World
from app.units import from_mm

How = Literal["touch", "hit"]
_COLOURS: dict[str, tuple[int, int, int]] = {"touch": (30, 170, 80), "hit": (230, 30, 30)}
_OVER = from_mm(2.0)  # the colour lies this far outside of the body, so that it is what is seen
_OPACITY = 0.75
_NUMBERS = itertools.count(1)


class Met:
    """The colour over two bodies.

    Args:
        scene: the session's.
        arm: as it is drawn.
    """

    def __init__(self, scene: viser.SceneApi, arm: ArmView):
        self._scene, self._arm = scene, arm
        self._handles: list[viser.SceneNodeHandle] = []
        self.shown: tuple[How, tuple[str, str]] | None = None

    def show(
        self, world: World, held: HeldTool | None, how: How | None, bodies: tuple[str, str] = ("", "")
    ) -> None:
        """Colours these bodies, by the names the guard has for them; None takes the colour away."""
        wanted = None if how is None else (how, bodies)
        if wanted == self.shown:
            return
        for handle in self._handles:
            handle.remove()
        self._handles, self.shown = [], wanted
        if how is None:
            return
        for path, solid in self._solids(world, held):
            if solid.link.replace("_", " ") in bodies:
                self._handles.append(self._over(path, solid, held, _COLOURS[how]))

    def _solids(self, world: World, held: HeldTool | None) -> list[tuple[str, Solid]]:
        """Everything that can be hit, with the node it hangs on."""
        found = [(self._arm.paths[solid.body], solid) for solid in robot_solids(world.robot)]
        if held is not None:
            found += [(held.path, solid) for solid in solids(held_shapes(world.robot))]
        return found + [("/cell", solid) for solid in solids(cell_obstacles(world))]

    def _over(
        self, path: str, solid: Solid, held: HeldTool | None, colour: tuple[int, int, int]
    ) -> viser.SceneNodeHandle:
        drawn = faces(solid.points) if solid.mesh is None else (solid.mesh.vertices, solid.mesh.triangles)
        vertices, triangles = np.asarray(drawn[0], float), drawn[1]
        if held is not None and path == held.path and held.bend is not None:
            vertices = held.bend(vertices)
        out = vertices - vertices.mean(axis=0)
        out /= np.maximum(np.linalg.norm(out, axis=1, keepdims=True), 1e-9)
        return self._scene.add_mesh_simple(
            f"{path}/met{next(_NUMBERS)}",
            (vertices + _OVER * out).astype(np.float32),
            np.asarray(triangles, np.uint32),
            color=colour,
            opacity=_OPACITY,
            cast_shadow=False,
            receive_shadow=False,
        )
