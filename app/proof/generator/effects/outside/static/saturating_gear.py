"""A gear that gives way quickly at first and then no more: tanh of the own angle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.outside.static._along import JointCurve, centred


@dataclass(frozen=True)
class SaturatingGear(JointCurve):
    key: str = "saturating_gear"

    def curve(self, cell, j):
        return np.tanh(3.0 * centred(cell, j))


EFFECT = SaturatingGear()
