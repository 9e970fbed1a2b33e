"""The table, the spike on it, and a fence behind the arm and beside it."""

from __future__ import annotations

import numpy as np

from app.kinematics.shapes import Shape, box, rod
from app.simulation.fence import fence_panels
from app.simulation.world import PLATE, World
from app.units import from_mm

_STEEL, _DARK, _TOP, _LEG = (0.74, 0.76, 0.79), (0.20, 0.22, 0.25), (0.55, 0.60, 0.66), (0.36, 0.39, 0.43)
_CONE = from_mm(60.0)  # length of the sharpened end
_ROD = from_mm(9.0)  # radius of the rod it is the end of
_FOOT = from_mm(45.0)
_TABLE = from_mm(40.0)  # thickness of the table's top
_GROUND = from_mm(520.0)  # edge of the ground plate on it
_EDGE = from_mm(620.0)


def table_corner(world: World) -> np.ndarray:
    """(3,) the corner of the table's top from which it lies towards +X and +Y of base [m]."""
    x, y, _ = world.p_base_spike_drawn
    return np.array([x - _EDGE / 2, y - _EDGE / 2, world.table_height])


def cell_obstacles(world: World) -> tuple[Shape, ...]:
    """What can be hit: table, spike, and the fence as closed panels; not the plate, which the tip may touch."""
    solid = (shape for shape in cell_shapes(world) if shape.link != "plate")
    return (*solid, *fence_panels(world))


def cell_shapes(world: World) -> tuple[Shape, ...]:
    """Table with four legs, a ground plate on it, and a spike that stands on both."""
    spike, top = world.p_base_spike_drawn, world.table_height
    x, y = float(spike[0]), float(spike[1])
    foot = np.array([x, y, top])
    shapes = [
        box((_EDGE, _EDGE, _TABLE), (x, y, top - _TABLE / 2), link="table", colour=_TOP),
        box((_GROUND, _GROUND, PLATE), (x, y, top + PLATE / 2), link="plate", colour=_STEEL),
        rod(foot, foot + _up(from_mm(14.0)), _FOOT, link="spike foot", colour=_DARK),
        rod(foot, spike - _up(_CONE), _ROD, link="spike rod", colour=_DARK),
        rod(spike - _up(_CONE), spike, _ROD, 0.0, link="spike", colour=_STEEL),
    ]
    reach = _EDGE / 2 - from_mm(35.0)
    for side in (-1, 1):
        for end in (-1, 1):
            leg = np.array([x + side * reach, y + end * reach, 0.0])
            shapes.append(rod(leg, leg + _up(top - _TABLE), from_mm(22.0), link="table leg", colour=_LEG))
    return tuple(shapes)


def _up(height: float) -> np.ndarray:
    return np.array([0.0, 0.0, height])
