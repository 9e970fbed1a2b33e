"""The user frame's axes in the cell."""

from __future__ import annotations

import viser

from app.geometry import Pose
from app.units import from_mm


class UserAxes:
    """Hidden until there is something to show."""

    def __init__(self, scene: viser.SceneApi):
        self._frame = scene.add_frame(
            "/user", axes_length=from_mm(180.0), axes_radius=from_mm(4.0), visible=False
        )

    def show(self, T_base_user: Pose | None) -> None:
        """At this pose, or not at all."""
        if T_base_user is not None:
            self._frame.wxyz = tuple(T_base_user.quaternion)
            self._frame.position = tuple(T_base_user.position)
        self._frame.visible = T_base_user is not None
