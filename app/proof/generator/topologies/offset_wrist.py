"""Six axes with three parallel ones and an offset wrist, the build of most collaborative arms."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.arm import Arm
from app.proof.generator.topologies._build import HALF, draw_arm


@dataclass(frozen=True)
class OffsetWrist:
    key: str = "offset_wrist"

    def draw(self, rng: np.random.Generator) -> Arm:
        size = rng.uniform(0.6, 1.4)
        upper, fore = size * rng.uniform(0.4, 0.65), size * rng.uniform(0.35, 0.6)
        d1, d4, d5, d6 = size * rng.uniform([0.09, 0.1, 0.08, 0.08], [0.2, 0.18, 0.13, 0.12])
        rows = [
            (0.0, HALF, d1, 0.0),
            (-upper, 0.0, 0.0, 0.0),
            (-fore, 0.0, 0.0, 0.0),
            (0.0, HALF, d4, 0.0),
            (0.0, -HALF, d5, 0.0),
            (0.0, 0.0, d6, 0.0),
        ]
        limits = [(-6.2, 6.2), (-3.3, 0.2), (-2.7, 2.7), (-6.2, 6.2), (-6.2, 6.2), (-6.2, 6.2)]
        return draw_arm(
            "offset_wrist",
            rng,
            rows,
            limits=limits,
            masses=[size**2 * m for m in (6.0, 11.0, 4.5, 1.8, 1.8, 0.4)],
            speed=[2.1, 2.1, 3.1, 3.1, 3.1, 3.1],
            effort=[size**3 * e for e in (250.0, 250.0, 120.0, 40.0, 40.0, 40.0)],
        )


TOPOLOGY = OffsetWrist()
