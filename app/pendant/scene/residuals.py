"""What each touch missed the fitted point by, as arrows from that point, magnified."""

from __future__ import annotations

import numpy as np
import viser

from app.calibration.result import ToolCalibration
from app.pendant.scene.exaggeration import factor_for
from app.units import from_mm, mm

_LONGEST = from_mm(300.0)  # the longest arrow may be this long
_PINK = (200, 30, 100)


def magnification(result: ToolCalibration) -> int:
    """The round factor that makes the longest residual clearly visible."""
    return factor_for(result.max, _LONGEST)


class Residuals:
    """Arrows and their numbers."""

    def __init__(self, scene: viser.SceneApi):
        self._scene = scene
        self._handles: list[viser.SceneNodeHandle] = []

    def show(self, result: ToolCalibration | None) -> None:
        """Draws the residuals of a result, or nothing."""
        for handle in self._handles:
            handle.remove()
        self._handles = []
        if result is None or not len(result.residual_vectors):
            return
        start = np.broadcast_to(result.p_base, result.residual_vectors.shape)
        ends = start + magnification(result) * result.residual_vectors
        self._handles.append(
            self._scene.add_arrows(
                "/residuals/arrows",
                np.stack([start, ends], axis=1).astype(np.float32),
                _PINK,
                shaft_radius=from_mm(3.5),
                head_radius=from_mm(9.0),
                head_length=from_mm(24.0),
            )
        )
        for number, (end, miss) in enumerate(zip(ends, result.per_point, strict=True)):
            self._handles.append(
                self._scene.add_label(
                    f"/residuals/label{number}",
                    f"{number + 1}: {mm(float(miss)):.2f} mm",
                    position=tuple(end),
                    font_screen_scale=0.8,
                    anchor="center-left",
                )
            )
