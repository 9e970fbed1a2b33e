"""Numbers typed in: a tool known from a drawing or from another controller."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.calibration.captures import Capture, Demo, Step
from app.calibration.modes._touches import DEMO_TOOL
from app.calibration.result import ToolCalibration
from app.errors import CellValueError
from app.geometry import Pose, convention


@dataclass(frozen=True)
class Direct:
    key: str = "direct"
    title: str = "Direct entry"
    least_touches: int = 0
    most_touches: int = 0
    default_touches: int = 0

    def steps(self, touches: int = 0) -> tuple[Step, ...]:
        return ()

    def solve(
        self,
        captures: Sequence[Capture] = (),
        *,
        position: Sequence[float] = (0.0, 0.0, 0.0),
        angles: Sequence[float] = (0.0, 0.0, 0.0),
        angle_convention: str = "ZYX",
        **_: Any,
    ) -> ToolCalibration:
        """The typed tool frame.

        Args:
            captures: none are used.
            position: (3,) [m].
            angles: three angles [rad] or four quaternion components.
            angle_convention: key of the convention that `angles` are in.

        Raises:
            CellValueError: not three finite numbers, or a quaternion of length 0.
            UnknownNameError: no such convention.
        """
        form = convention(angle_convention)
        place, numbers = np.array(position, float), np.array(angles, float)
        if place.shape != (3,) or not np.isfinite(place).all():
            raise CellValueError(
                "the position is no triple of numbers", column="x, y, z", expected="3 finite numbers"
            )
        length = len(form.columns)
        whole = numbers.shape == (length,) and np.isfinite(numbers).all()
        if not whole or (not form.angular and not np.linalg.norm(numbers) > 1e-6):
            raise CellValueError(
                "the orientation cannot be used",
                column=", ".join(form.columns),
                expected=f"{length} finite numbers",
            )
        return ToolCalibration(
            T_flange_tool=Pose.of(form.to_rotation(numbers), place),
            p_base=np.zeros(3),
            method=self.key,
            orientation=self.key,
            residual_vectors=np.zeros((0, 3)),
            delta=0.0,
            covariance=np.zeros((3, 3)),
            sigma=0.0,
            dof=0,
            condition=1.0,
            rank=3,
        )

    def demo(self, *, touches: int = 0, noise: float = 0.0, seed: int = 0) -> Demo:
        angles = convention("ZYX").from_rotation(DEMO_TOOL.rotation)
        return Demo((), DEMO_TOOL, {"position": tuple(DEMO_TOOL.position), "angles": tuple(angles)})


MODE = Direct()
