"""Where to look from at what stands in the cell's place: two robots and a tracker, or a recording's arm."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from app.kinematics import RobotModel
from app.scene.camera import View, framed

Seen = Callable[[], tuple[RobotModel, np.ndarray]]  # an arm and where it stands (n,)

#: Views that look straight along an axis, a little from above.
_SQUARE = {"side": np.array([0.0, -1.0, 0.06]), "front": np.array([1.0, 0.0, 0.06])}
_CLOSE_UP = 0.3  # of how far all of it reaches: from here one flange fills the window


@dataclass(frozen=True, eq=False)
class Instead:
    """What is shown in the cell's place.

    Args:
        points: (n, 3) all that has to be seen [m].
        near: (3,) what a near view is about [m].
        towards_eye: (3,) from where all of it is seen best.
    """

    points: np.ndarray
    near: np.ndarray
    towards_eye: np.ndarray

    def view(self, name: str, aspect: float) -> View:
        """One of the named places, for a window of this shape; the side and the front keep all in view."""
        if name == "close":
            across = float(np.linalg.norm(self.points.max(0) - self.points.min(0)))
            back = self.towards_eye / np.linalg.norm(self.towards_eye)
            return self.near + _CLOSE_UP * across * back, self.near
        return framed(self.points, _SQUARE.get(name, self.towards_eye), aspect)
