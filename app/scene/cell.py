"""The cell as it is drawn: table, spike, fence."""

from __future__ import annotations

import viser

from app.scene.arm import draw_shapes
from app.simulation.cell_shapes import cell_shapes
from app.simulation.fence import fence_shapes
from app.simulation.world import World


def draw_cell(scene: viser.SceneApi, world: World) -> viser.FrameHandle:
    """Draws the cell, in place of the one before; the node it hangs on."""
    return draw_shapes(scene, "/cell", (*cell_shapes(world), *fence_shapes(world)))
