"""A zero that swings to and fro over the time of the recording."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.outside.static._along import JointCurve


@dataclass(frozen=True)
class DailyWave(JointCurve):
    key: str = "daily_wave"

    def curve(self, cell, j):
        t = cell.t / max(cell.t[-1], 1e-9)
        return np.sin(2.0 * np.pi * 2.5 * t)


EFFECT = DailyWave()
