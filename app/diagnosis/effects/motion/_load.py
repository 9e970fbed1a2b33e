"""A body on the flange: what its mass and centre do to the joints."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.motion._law import Law, Values
from app.kinematics.dynamics import point_mass

SMALLEST = 1e-3  # kg; below it a centre means nothing


class Load(Law):
    """A body on the flange; its centre in the flange frame. Its inertia is fitted along but not named."""

    units: ClassVar = {"mass": "kg", "com_x": "m", "com_y": "m", "com_z": "m"}
    linear = ("mass", "mx", "my", "mz", "ixx", "ixy", "iyy", "ixz", "iyz", "izz")
    shared = True

    def values(self, coefficients: np.ndarray, shape: Values) -> dict[str, float]:
        mass = float(coefficients[0])
        safe = mass if abs(mass) > SMALLEST else SMALLEST
        com = coefficients[1:4] / safe
        return {
            "mass": mass,
            "com_x": float(com[0]),
            "com_y": float(com[1]),
            "com_z": float(com[2]),
            **shape,
        }

    def body(self, values: Values) -> np.ndarray:
        """(10,) inertial parameters."""
        return point_mass(values["mass"], np.array([values["com_x"], values["com_y"], values["com_z"]]))
