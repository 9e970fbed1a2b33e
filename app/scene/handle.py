"""The drag handle at the tool point."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import viser

from app.geometry import Pose

#: Phase of a drag ("start", "update", "end") and T_base_tool that is wanted.
Dragged = Callable[[str, Pose], None]


class Handle:
    """Arrows and arcs that a person drags; says where the tool is wanted and never moves itself while dragged.

    Args:
        scene: the browser's scene.
        dragged: called on the event loop; must only enqueue.
        scale: size of the handle [m].
    """

    def __init__(self, scene: viser.SceneApi, dragged: Dragged, scale: float):
        self.dragging, self.length = False, scale
        self._controls = scene.add_transform_controls(
            "/handle", scale=scale, line_width=3.0, depth_test=False, opacity=0.9
        )

        @self._controls.on_update
        async def _(event: viser.TransformControlsEvent) -> None:
            self.dragging = event.phase != "end"
            target = event.target
            dragged(event.phase, Pose.from_quaternion(np.array(target.wxyz), np.array(target.position)))

    def place(self, pose: Pose) -> None:
        """Puts the handle where the tool is, unless somebody holds it."""
        if not self.dragging:
            self._controls.wxyz = tuple(pose.quaternion)
            self._controls.position = tuple(pose.position)

    def allow(self, *, shift: bool, turn: bool) -> None:
        """Which of its parts can be dragged."""
        self._controls.disable_axes = not shift
        self._controls.disable_sliders = not shift
        self._controls.disable_rotations = not turn

    @property
    def visible(self) -> bool:
        return self._controls.visible

    @visible.setter
    def visible(self, value: bool) -> None:
        self._controls.visible = value

    def remove(self) -> None:
        self._controls.remove()
