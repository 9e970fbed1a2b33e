"""Dry friction that is larger near standstill and fades with speed (Stribeck 1902)."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from app.diagnosis.effects.dynamic._law import JointLaw, Values, choice, direction
from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.thresholds.friction import BLUNT

SHARES = (0.03, 0.06, 0.12, 0.25, 0.45)  # of the joint's usual speed: speeds at which it has faded, tried


class StribeckFriction(JointLaw):
    key = "stribeck_friction"
    title = "dry friction that is larger near standstill"
    family = "friction"
    driver = "speed"
    equation = "tau = stribeck * exp(-(qd / stribeck_speed)^2) * sign(qd)"
    units: ClassVar = {"stribeck": "Nm", "stribeck_speed": "rad/s"}
    blunt = True
    linear = ("stribeck",)
    positive = ("stribeck",)
    drifts = True
    within = "coulomb_friction"
    bent: ClassVar = {"stribeck_speed": 0.7}  # nepers to either side within which the fit may bend it

    def forms(self, state: State, joint: int) -> list[tuple[Values, float]]:
        speeds = [share * float(state.speed[joint]) for share in SHARES]
        speeds = [speed for speed in speeds if speed > BLUNT * state.width[joint]]
        return [({"stribeck_speed": speed}, choice(len(SHARES)) / 2) for speed in speeds]

    def least(self, state: State, place: Place, name: str) -> float:
        return BLUNT * float(state.width[int(place.where["joint"]) - 1])

    def column(self, state: State, joint: int, fixed: Values) -> np.ndarray:
        fade = np.exp(-((state.qd[:, joint] / fixed["stribeck_speed"]) ** 2))
        return (fade * direction(state, joint, fixed))[:, None]


EFFECT = StribeckFriction()
