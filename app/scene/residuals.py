"""What each touch missed the fitted point by, as arrows from that point, magnified."""

from __future__ import annotations

import numpy as np
import viser

from app.calibration.result import ToolCalibration
from app.scene.exaggeration import factor_for
from app.units import from_mm

_LONGEST = from_mm(300.0)  # the longest arrow may be this long
_PINK = (200, 30, 100)


def magnification(result: ToolCalibration) -> int:
    """The round factor that makes the longest residual clearly visible."""
    return factor_for(result.max, _LONGEST)


def arrow_ends(result: ToolCalibration) -> np.ndarray:
    """(n, 3) where the arrows end, in base [m]."""
    return result.p_base + magnification(result) * result.residual_vectors


class Residuals:
    """The arrows; captions.py says what they are."""

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
        ends = arrow_ends(result)
        start = np.broadcast_to(result.p_base, ends.shape)
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
