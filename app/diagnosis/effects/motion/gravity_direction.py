"""The arm does not stand upright: gravity points elsewhere than the description says."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.motion._law import Law, Place, Values, Where
from app.diagnosis.effects.motion._state import State
from app.kinematics.robot import GRAVITY

SIZE = 0.05  # relative: gravity itself differs by half a percent from pole to equator, the rest is what a log tells


class GravityDirection(Law):
    key = "gravity_direction"
    title = "gravity points elsewhere"
    driver = "gravity_torque"
    equation = "tau = tau_rigid(g) - tau_rigid(g of the description)"
    units: ClassVar = {"gx": "m/s^2", "gy": "m/s^2", "gz": "m/s^2"}
    linear = ("gx", "gy", "gz")
    shared = True
    corrected = True

    def places(self, state: State) -> list[Place]:
        return [Place({"body": "base", "driver": self.driver})]

    def columns(self, state: State, where: Where, shape: Values) -> np.ndarray:
        return state.gravity_columns

    def values(self, coefficients: np.ndarray, shape: Values) -> dict[str, float]:
        return dict(zip(self.linear, map(float, GRAVITY + coefficients), strict=True))

    def apply(
        self, state: State, where: Where, values: Values, torque: np.ndarray | None = None
    ) -> np.ndarray:
        change = np.array([values[k] for k in self.linear]) - GRAVITY
        return state.gravity_columns @ change

    def lawful(self, values: Values) -> bool:
        """The arm leans; gravity's size is what it is everywhere."""
        size = np.linalg.norm([values[k] for k in self.linear]) / np.linalg.norm(GRAVITY)
        return bool(abs(size - 1.0) < SIZE)

    def explain(self, where: Where, values: Values) -> str:
        g = np.array([values[k] for k in self.linear])
        tilt = np.arccos(np.clip(g @ GRAVITY / np.linalg.norm(g) / np.linalg.norm(GRAVITY), -1, 1))
        return (
            f"The base leans by {tilt:.4g} rad: gravity is ({g[0]:.3f}, {g[1]:.3f}, {g[2]:.3f}) m/s^2 in it."
        )


EFFECT = GravityDirection()
