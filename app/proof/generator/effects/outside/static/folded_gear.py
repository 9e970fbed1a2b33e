"""A deviation that does not know the sign: |own angle| from the middle of the range."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.outside.static._along import JointCurve, centred


@dataclass(frozen=True)
class FoldedGear(JointCurve):
    key: str = "folded_gear"

    def curve(self, cell, j):
        return np.abs(centred(cell, j)) - 0.5


EFFECT = FoldedGear()
