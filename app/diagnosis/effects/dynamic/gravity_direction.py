"""The arm does not stand upright: gravity points elsewhere than the description says."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import ClassVar

import numpy as np

from app.diagnosis.effects.described import Gravity
from app.diagnosis.effects.dynamic._law import Law, Torques, Values, Where, everywhere
from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.hypothesis import Hypothesis, Read, Trial
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.result import Parameter
from app.diagnosis.thresholds.readings import TILTED
from app.kinematics import RobotModel
from app.kinematics.robot import GRAVITY
from app.units import DEG_PER_RAD

TILT = 1.0  # m/s^2: nominal size of the part across, 6 degrees
_WHERE = {"body": "base", "driver": "gravity_torque"}
_NAMES = ("gx", "gy", "gz")
_FIXED = ("fixed_gx", "fixed_gy", "fixed_gz")


class GravityDirection(Law):
    """Gravity is linear in the torques: its part across the direction assumed is fitted, its size is kept."""

    key = "gravity_direction"
    title = "gravity points elsewhere"
    family = "mounting"
    driver = "gravity_torque"
    equation = "tau = tau_rigid(g) - tau_rigid(g of the description)"
    units: ClassVar = {"gx": "m/s^2", "gy": "m/s^2", "gz": "m/s^2"}
    linear = ("across1", "across2")
    undone = True
    carried = True

    def places(self, situation: State) -> Iterable[Place]:
        g = situation.hypothesis.gravity
        if not np.any(g):  # recorded without gravity: nothing points anywhere
            return []
        return [Place(dict(_WHERE), dict(zip(_FIXED, map(float, g), strict=True)))]

    def columns(self, columns: State, place: Place) -> Torques:
        return everywhere(columns.gravity_columns @ _across(place.fixed).T)

    def widths(self, situation: State, place: Place, found: Torques | None = None) -> np.ndarray:
        return np.full(2, TILT)

    def saved(self, place: Place, values: np.ndarray) -> dict[str, float]:
        g = _leaning(place.fixed, values)
        return dict(zip(_NAMES, map(float, g), strict=True))

    def readings(self, now: Hypothesis, read: Read) -> Iterable[Trial]:
        """Gravity by three numbers (it is linear), its size as it is everywhere."""
        if not np.any(now.gravity):
            return
        samples = read.samples
        beyond, gram, right = samples.y - samples.description, np.zeros((3, 3)), np.zeros(3)
        weight = samples.alive / np.maximum(np.std(samples.y, axis=0), 1e-9) ** 2
        for j in range(now.joints):
            columns = read.off(j, samples.state.gravity_columns[:, j])
            gram += weight[j] * columns.T @ columns
            right += weight[j] * columns.T @ beyond[:, j]
        g = now.gravity + np.linalg.solve(gram + 1e-9 * np.trace(gram) * np.eye(3), right)
        size = float(np.linalg.norm(g))
        if size < 1.0:
            return
        leaning = replace(now, gravity=g * float(np.linalg.norm(GRAVITY)) / size)
        if leaning.tilt * DEG_PER_RAD > TILTED:
            fixed: dict[str, float] = dict(zip(_FIXED, map(float, leaning.gravity), strict=True))
            yield Trial(self, Place(dict(_WHERE), fixed), leaning)

    def read_as(self, hypothesis: Hypothesis, where: Where, parameters: Values) -> Hypothesis:
        return replace(hypothesis, gravity=_vector(parameters))

    def between(self, now: Hypothesis, before: Hypothesis) -> Iterable[tuple[Where, Values]]:
        if np.any(now.gravity) and not np.allclose(now.gravity, before.gravity):
            yield dict(_WHERE), dict(zip(_NAMES, map(float, now.gravity), strict=True))

    def held(self, hypothesis: Hypothesis, place: Place) -> np.ndarray:
        tilt = min(hypothesis.tilt, np.pi / 2)
        return np.array([float(np.linalg.norm(hypothesis.gravity)) * np.sin(tilt), 0.0])

    def torque(self, state: State, where: Where, parameters: Values) -> Torques:
        return everywhere(state.gravity_columns @ (_vector(parameters) - GRAVITY))

    def undo(self, hypothesis: Hypothesis, place: Place, values: np.ndarray) -> Hypothesis:
        return replace(hypothesis, gravity=_leaning(place.fixed, values))

    def reported(self, place: Place, values: np.ndarray, covariance: np.ndarray) -> tuple[Parameter, ...]:
        across = _across(place.fixed)
        std = np.sqrt(np.maximum(np.diag(across.T @ covariance @ across), 0.0))
        return tuple(
            Parameter(name, value, float(s), "m/s^2")
            for (name, value), s in zip(self.saved(place, values).items(), std, strict=True)
        )

    def described(self, robot: RobotModel, where: Where, parameters: Values) -> tuple[Gravity, ...]:
        return (Gravity(_vector(parameters)),) if parameters.keys() >= set(_NAMES) else ()

    def sentence(self, place: Place, parameters: tuple[Parameter, ...]) -> str:
        g = np.array([p.value for p in parameters[:3]])
        tilt = np.arccos(np.clip(g @ GRAVITY / np.linalg.norm(g) / np.linalg.norm(GRAVITY), -1, 1))
        return (
            f"The base leans by {tilt:.4g} rad: gravity is ({g[0]:.3f}, {g[1]:.3f}, {g[2]:.3f}) m/s^2 in it."
        )


def _vector(parameters: Values) -> np.ndarray:
    """(3,) gravity as saved."""
    return np.array([parameters[k] for k in _NAMES])


def _across(fixed: Mapping[str, float]) -> np.ndarray:
    """(2, 3) unit vectors across the gravity assumed."""
    g = np.array([fixed[k] for k in _FIXED])
    return np.linalg.svd(g[None])[2][1:]


def _leaning(fixed: Mapping[str, float], values: np.ndarray) -> np.ndarray:
    """(3,) gravity with a part across added and its size kept."""
    g = np.array([fixed[k] for k in _FIXED])
    leant = g + _across(fixed).T @ np.asarray(values, float)
    return leant * np.linalg.norm(g) / np.linalg.norm(leant)


EFFECT = GravityDirection()
