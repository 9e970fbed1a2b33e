"""The flange pushes on something for a while."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import ClassVar

import numpy as np

from app.diagnosis.effects.dynamic._law import SHARE, Law, Torques, Values, Where, everywhere
from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.result import Parameter

_FORCE = ("force_x", "force_y", "force_z")
_MOMENT = ("moment_x", "moment_y", "moment_z")
#: m: from the flange's origin to where it is touched, as tools are long; a force there turns the flange, too.
_REACH = 0.15


class Contact(Law):
    """Something is touched with the tool, or with the hand: a force, and as it acts beside the flange a moment."""

    key = "contact"
    title = "the flange pushes on something"
    family = "events"
    driver = "time"
    equation = "tau = (from_s <= t < to_s) * J^T (force, moment)"
    units: ClassVar[Mapping[str, str]] = {**dict.fromkeys(_FORCE, "N"), **dict.fromkeys(_MOMENT, "Nm")}
    linear = _FORCE + _MOMENT
    ends = ("from_s", "to_s")
    swells = True
    hidden = True
    least_joints = 2  # a torque for a while on one joint is no force at a flange
    lasting = False

    def places(self, situation: State) -> Iterable[Place]:
        return [Place({"body": "tool", "driver": "time"}, scan=True)]

    def shape(self, state: State, place: Place) -> np.ndarray:
        where = place.where
        inside = (state.t >= where.get("from_s", -np.inf)) & (state.t < where.get("to_s", np.inf))
        shape = inside.astype(float)
        if place.fixed.get("fixed_swell"):  # rises and falls as half a sine
            length = max(where["to_s"] - where["from_s"], 1e-6)
            shape = shape * np.sin(np.pi * np.clip((state.t - where["from_s"]) / length, 0.0, 1.0))
        return shape

    def columns(self, columns: State, place: Place) -> Torques:
        return everywhere(columns.wrench_columns * self.shape(columns, place)[:, None, None])

    def torque(self, state: State, where: Where, parameters: Values) -> Torques:
        """As of any law; models saved before 2026-12 have no moment, their forces act at the flange's origin."""
        return super().torque(state, where, {**dict.fromkeys(_MOMENT, 0.0), **parameters})

    def widths(self, situation: State, place: Place, found: Torques | None = None) -> np.ndarray:
        lever = np.sqrt(np.mean(situation.wrench_columns[:, :, :3] ** 2, axis=(0, 2)))
        near = lever > 1e-3
        force = SHARE * float(np.median(situation.size[near] / lever[near])) if near.any() else 1.0
        return np.repeat(max(force, 1.0) * np.array([1.0, _REACH]), 3)

    def sentence(self, place: Place, parameters: tuple[Parameter, ...]) -> str:
        force = float(np.linalg.norm([p.value for p in parameters[:3]]))
        return (
            f"Contact from {place.where['from_s']:.2f} to {place.where['to_s']:.2f} s: "
            f"the flange pushes with {force:.3g} N."
        )


EFFECT = Contact()
