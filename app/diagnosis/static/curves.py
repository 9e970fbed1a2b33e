"""Smooth curves of a driver, without a law: what a named law is measured against, and what has no name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from app.diagnosis.static.effect import Place, Quantity, StaticEffect
from app.diagnosis.static.situation import Situation

_FLAT = 1e-9


def smooth(driver: np.ndarray, degree: int) -> np.ndarray:
    """(m, degree) Legendre polynomials of degree 1 … `degree` of the driver brought to -1 … 1; zeros where it rests."""
    low, high = float(driver.min()), float(driver.max())
    if high - low < _FLAT:
        return np.zeros((len(driver), degree))
    u = 2.0 * (driver - low) / (high - low) - 1.0
    return np.polynomial.legendre.legvander(u, degree)[:, 1:]


def shape_functions(situation: Situation, where: Mapping[str, Any], curve: str) -> np.ndarray:
    """(m, d) functions of the driver that a finding at `where` could follow instead of its law.

    Args:
        curve: "own_angle", "gravity_torque", "sign", "source" or "pace".
    """
    joint = int(where.get("joint", 1)) - 1
    torque = situation.torque[:, joint]
    if curve == "own_angle":
        return smooth(situation.q[:, joint], 6)
    if curve == "gravity_torque":
        return smooth(torque, 4)
    if curve == "source":
        return smooth(situation.q[:, int(where["source_joint"]) - 1], 4)
    if curve == "sign":
        sign = situation.approach[:, joint] if where.get("driver") == "approach" else np.sign(torque)
        parts = [sign, smooth(torque, 2)]
        parts += [sign * _sized(size) for size in (np.abs(torque), np.abs(situation.move[:, joint]))]
        if where.get("driver") == "approach":
            parts.append(sign * _sized(situation.q[:, joint]))
        return np.column_stack(parts)
    driver = situation.temperature if where.get("driver") == "temperature" else situation.time
    assert driver is not None
    return smooth(driver, 4)


def _sized(values: np.ndarray) -> np.ndarray:
    """Brought to about one, around its mean."""
    spread = float(values.std())
    return (values - values.mean()) / spread if spread > _FLAT else np.zeros_like(values)


class JointCurve(StaticEffect):
    """A joint displaced by a free curve of a driver: structure that has a place but no name."""

    key = "joint_curve"
    title = "Something without a name"
    equation = "q_true = q + curve(driver)"

    def places(self, situation):
        return []

    def quantities(self, situation, place):
        return tuple(Quantity(f"c{i}", "deg") for i in range(_functions(situation, place).shape[1]))

    def apply(self, cell, situation, place, values):
        return cell.add_joint(place.where["joint"] - 1, _functions(situation, place) @ values)

    def columns(self, columns, place):
        functions = _functions(columns.situation, place)
        return columns.joint[:, :, place.where["joint"] - 1, None] * functions[:, None, :]

    def sentence(self, place, parameters):
        return f"Joint {place.where['joint']} is off by something that follows {place.where.get('driver')}."


def _functions(situation: Situation, place: Place) -> np.ndarray:
    functions = shape_functions(situation, place.where, CURVES[int(place.fixed["curve"])])
    return np.column_stack([np.ones(len(functions)), functions])


#: Names of the curves by their number, as a place keeps it.
CURVES = ("own_angle", "gravity_torque", "sign", "source", "pace")
JOINT_CURVE = JointCurve()


def joint_curve_place(where: Mapping[str, Any], curve: str) -> Place:
    """Where a free curve stands in for a finding."""
    return Place(dict(where), {"curve": float(CURVES.index(curve))})
