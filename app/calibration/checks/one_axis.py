"""Touches that turn almost about one axis: solvable, but one direction of the tool point is poorly known."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.calibration.captures import Capture, of_role, stack
from app.calibration.result import ToolCalibration, Warning_
from app.calibration.wording import remark

#: Condition beyond which the weakest direction is ten times worse than the best.
WEAK = 10.0


@dataclass(frozen=True)
class OneAxis:
    key: str = "one_axis"

    def look(
        self, result: ToolCalibration, captures: Sequence[Capture], context: dict[str, Any]
    ) -> list[Warning_]:
        rotations, _ = stack(of_role(captures, "touch"))
        if len(rotations) < 3 or result.condition < WEAK or "known" in {r for c in captures for r in c.roles}:
            return []
        _, _, directions = np.linalg.svd((rotations - rotations.mean(axis=0)).reshape(-1, 3))
        weak = directions[-1] * np.sign(directions[-1][np.argmax(np.abs(directions[-1]))])
        along = "(" + ", ".join(f"{v:.2f}" for v in np.round(weak, 2) + 0.0) + ")"
        return [remark(self.key, along=along, times=result.condition)]


CHECK = OneAxis()
