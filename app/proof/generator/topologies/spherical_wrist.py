"""Six axes, the last three through one point."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.arm import Arm
from app.proof.generator.topologies._build import HALF, draw_arm


@dataclass(frozen=True)
class SphericalWrist:
    key: str = "spherical_wrist"

    def draw(self, rng: np.random.Generator) -> Arm:
        size = rng.uniform(0.7, 1.5)
        a1, a2, a3 = size * np.array(
            [rng.uniform(0.02, 0.25), rng.uniform(0.4, 0.7), rng.uniform(-0.05, 0.15)]
        )
        d1, d4, d6 = size * np.array([rng.uniform(0.3, 0.5), rng.uniform(0.4, 0.7), rng.uniform(0.07, 0.16)])
        rows = [
            (a1, -HALF, d1, 0.0),
            (a2, 0.0, 0.0, -HALF),
            (a3, -HALF, 0.0, 0.0),
            (0.0, HALF, d4, 0.0),
            (0.0, -HALF, 0.0, 0.0),
            (0.0, 0.0, d6, 0.0),
        ]
        limits = [(-2.9, 2.9), (-1.4, 1.9), (-2.0, 1.3), (-3.1, 3.1), (-2.0, 2.0), (-6.1, 6.1)]
        return draw_arm(
            "spherical_wrist",
            rng,
            rows,
            limits=limits,
            masses=[size**2 * m for m in (18.0, 14.0, 9.0, 5.0, 2.5, 0.6)],
            speed=[2.6, 2.4, 2.6, 5.0, 5.0, 6.5],
            effort=[size**3 * e for e in (250.0, 250.0, 150.0, 40.0, 35.0, 20.0)],
        )


TOPOLOGY = SphericalWrist()
