"""Recorded flange poses as small frames; captions.py numbers them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import viser

from app.calibration.captures import Capture
from app.units import from_mm

_LENGTH, _RADIUS = from_mm(80.0), from_mm(3.5)


class Marks:
    """The frames of all recorded points; drawn anew when the list changes."""

    def __init__(self, scene: viser.SceneApi):
        self._scene = scene
        self._handles: list[viser.SceneNodeHandle] = []

    def show(self, captures: Sequence[Capture]) -> None:
        """Draws these and takes away what was there."""
        for handle in self._handles:
            handle.remove()
        self._handles = []
        if not captures:
            return
        poses = [capture.T_base_flange for capture in captures]
        self._handles.append(
            self._scene.add_batched_axes(
                "/marks/frames",
                np.array([pose.quaternion for pose in poses]),
                np.array([pose.position for pose in poses]),
                axes_length=_LENGTH,
                axes_radius=_RADIUS,
            )
        )
