"""The tool frame that was found, drawn on the tool."""

from __future__ import annotations

import viser

from app.geometry import Pose
from app.units import from_mm

_LENGTH, _RADIUS = from_mm(160.0), from_mm(4.0)


class ToolAxes:
    """Axes that hang on the flange.

    Args:
        flange_path: scene node of the flange.
    """

    def __init__(self, scene: viser.SceneApi, flange_path: str):
        self._frame = scene.add_frame(
            f"{flange_path}/found",
            axes_length=_LENGTH,
            axes_radius=_RADIUS,
            origin_radius=from_mm(7.0),
            visible=False,
        )

    def show(self, T_flange_tool: Pose | None) -> None:
        """Draws the frame, or hides it."""
        if T_flange_tool is not None:
            self._frame.wxyz = tuple(T_flange_tool.quaternion)
            self._frame.position = tuple(T_flange_tool.position)
        self._frame.visible = T_flange_tool is not None
