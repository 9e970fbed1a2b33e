"""Torque without a name: a smooth curve along a joint's angle, speed or time, for what no law explains."""

from __future__ import annotations

from collections.abc import Iterable
from typing import ClassVar

import numpy as np

from app.diagnosis.effects.dynamic._law import Law, Torques, Values, Where
from app.diagnosis.effects.effect import Level, Place, Quantity
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.thresholds.evidence import UNKNOWN

KNOTS = 9
DRIVERS = ("own_angle", "speed", "time", "acceleration", "gravity_torque")
_NAMES = tuple(f"height{k}" for k in range(1, KNOTS + 1))


class SmoothTorque(Law):
    key = "smooth_torque"
    title = "torque that follows no law of the library"
    family = "unnamed"
    level = Level.UNKNOWN
    penalty = UNKNOWN
    equation = "tau = curve(x), x = q, qd, qdd, t or tau_rigid"
    units: ClassVar = dict.fromkeys(_NAMES, "Nm")
    linear = _NAMES

    def places(self, situation: State) -> Iterable[Place]:
        out = []
        for j in range(situation.joints):
            for driver in DRIVERS:
                x = _driver(situation, j, driver)
                low, high = (float(v) for v in np.quantile(x, [0.005, 0.995]))
                if high - low > 1e-6 and (driver == "time" or situation.moves(j)):
                    out.append(
                        Place({"joint": j + 1, "driver": driver}, {"fixed_from": low, "fixed_to": high})
                    )
        return out

    def quantities(self, situation: State, place: Place) -> tuple[Quantity, ...]:
        return tuple(Quantity(name, "Nm", 1.0) for name in self.linear)

    def columns(self, columns: State, place: Place) -> Torques:
        """Linear B-splines (hats) on even knots; constant beyond the ends, so that nothing is extrapolated."""
        joint = int(place.where["joint"]) - 1
        low, high = place.fixed["fixed_from"], place.fixed["fixed_to"]
        x = (_driver(columns, joint, place.where["driver"]) - low) / max(high - low, 1e-12) * (KNOTS - 1)
        x = np.clip(x, 0.0, KNOTS - 1)
        return {joint: np.maximum(1.0 - np.abs(x[:, None] - np.arange(KNOTS)), 0.0)}

    def widths(self, situation: State, place: Place, found: Torques | None = None) -> np.ndarray:
        joint = int(place.where["joint"]) - 1
        return np.full(KNOTS, 0.1 * situation.size[joint])

    def lasts(self, where: Where) -> bool:
        return super().lasts(where) and where.get("driver") != "time"

    def torque(self, state: State, where: Where, parameters: Values) -> Torques:
        values = np.array([parameters[k] for k in self.linear])
        return {j: c @ values for j, c in self.columns(state, Place(where, dict(parameters))).items()}


def _driver(state: State, joint: int, driver: str) -> np.ndarray:
    return {
        "own_angle": state.q[:, joint],
        "speed": state.qd[:, joint],
        "acceleration": state.qdd[:, joint],
        "gravity_torque": state.gravity_torque[:, joint],
        "time": state.t,
    }[driver]


EFFECT = SmoothTorque()
