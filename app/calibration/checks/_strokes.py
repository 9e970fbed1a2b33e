"""What several checks need: the strokes as vectors in the flange."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from app.calibration.captures import Capture, of_role
from app.calibration.result import ToolCalibration

AXES = ("x", "y", "z")


def strokes(result: ToolCalibration, captures: Sequence[Capture]) -> dict[str, np.ndarray]:
    """Axis name -> (3,) way of the tip from the origin, in the flange [m]; {} without an origin."""
    origins = of_role(captures, "origin")
    if not origins:
        return {}
    start = origins[0].T_base_flange
    found = {}
    for name in AXES:
        for capture in of_role(captures, name)[:1]:
            tip = capture.T_base_flange.apply(result.tool_point)
            found[name] = start.rotation.T @ (tip - start.apply(result.tool_point))
    return found
