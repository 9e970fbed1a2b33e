"""A worn stretch of teeth: a square wave over the own angle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.outside.static._along import JointCurve


@dataclass(frozen=True)
class ToothedGear(JointCurve):
    key: str = "toothed_gear"

    def curve(self, cell, j):
        return np.sign(np.sin(7.0 * cell.q[:, j] + 0.4))


EFFECT = ToothedGear()
