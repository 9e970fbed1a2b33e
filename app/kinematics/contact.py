"""How far what one frame carries is from what stands still: a tool's tip and the spike it touches."""

from __future__ import annotations

import copy
from collections.abc import Sequence

import coal  # pyright: ignore[reportMissingImports]  (found through a .pth hook)

from app.geometry.pose import Pose
from app.kinematics.collision import coal_solid
from app.kinematics.shapes import Shape


class Contact:
    """Distances of two rigid groups of solids. Not for two threads at once.

    Args:
        carried: shapes in the frame that moves.
        fixed: shapes in the frame that stands.
    """

    def __init__(self, carried: Sequence[Shape], fixed: Sequence[Shape]):
        self._carried = [(coal_solid(shape), shape.T_body_shape) for shape in carried]
        self._fixed = [(coal_solid(shape), _transform(shape.T_body_shape)) for shape in fixed]
        self._request, self._result = coal.DistanceRequest(), coal.DistanceResult()

    def again(self) -> Contact:
        """The same groups for another thread: solids are shared, what is reckoned with is not."""
        out = copy.copy(self)
        out._request, out._result = coal.DistanceRequest(), coal.DistanceResult()
        return out

    def distance(self, T_fixed_carried: Pose) -> float:
        """The least distance [m], negative by how deep they overlap; infinite where one group is empty."""
        least = float("inf")
        for solid, placed in self._carried:
            here = _transform(T_fixed_carried @ placed)
            for other, there in self._fixed:
                self._result.clear()
                least = min(least, coal.distance(solid, here, other, there, self._request, self._result))
        return least


def _transform(pose: Pose) -> coal.Transform3s:
    return coal.Transform3s(pose.rotation, pose.position)
