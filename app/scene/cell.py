"""The cell as it is drawn: table, spike, fence."""

from __future__ import annotations

from functools import lru_cache

import viser

from app.scene.arm import Mesh, draw_meshes, merged
from app.simulation.cell_shapes import cell_shapes
from app.simulation.fence import fence_shapes
from app.simulation.world import World


def draw_cell(scene: viser.SceneApi, world: World) -> viser.FrameHandle:
    """Draws the cell, in place of the one before; the node it hangs on."""
    return draw_meshes(scene, "/cell", _meshes(world))


@lru_cache(maxsize=16)
def _meshes(world: World) -> tuple[Mesh, ...]:
    """Worked out once for all who work in this cell."""
    return merged((*cell_shapes(world), *fence_shapes(world)))
