"""Seven axes, shoulder, elbow and wrist in one line at zero."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.arm import Arm
from app.proof.generator.topologies._build import HALF, draw_arm


@dataclass(frozen=True)
class SevenAxes:
    key: str = "seven_axes"

    def draw(self, rng: np.random.Generator) -> Arm:
        size = rng.uniform(0.8, 1.2)
        d1, d3, d5, d7 = size * rng.uniform([0.3, 0.36, 0.34, 0.1], [0.37, 0.45, 0.42, 0.2])
        elbow = size * rng.uniform(0.05, 0.1) if rng.random() < 0.5 else 0.0
        wrist = size * rng.uniform(0.05, 0.1) if rng.random() < 0.5 else 0.0
        rows = [
            (0.0, -HALF, d1, 0.0),
            (0.0, HALF, 0.0, 0.0),
            (elbow, HALF, d3, 0.0),
            (-elbow, -HALF, 0.0, 0.0),
            (0.0, -HALF, d5, 0.0),
            (wrist, HALF, 0.0, 0.0),
            (0.0, 0.0, d7, 0.0),
        ]
        limits = [(-2.9, 2.9), (-2.0, 2.0), (-2.9, 2.9), (-2.1, 2.1), (-2.9, 2.9), (-2.0, 2.0), (-3.0, 3.0)]
        return draw_arm(
            "seven_axes",
            rng,
            rows,
            limits=limits,
            masses=[size**2 * m for m in (5.0, 5.0, 4.0, 3.5, 2.5, 2.0, 0.6)],
            speed=[1.7, 1.7, 1.8, 2.2, 2.4, 3.1, 3.1],
            effort=[size**3 * e for e in (200.0, 200.0, 120.0, 120.0, 100.0, 40.0, 40.0)],
        )


TOPOLOGY = SevenAxes()
