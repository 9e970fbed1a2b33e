"""Two parallel turns, one slide and a last turn."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.arm import Arm
from app.proof.generator.topologies._build import draw_arm


@dataclass(frozen=True)
class Scara:
    key: str = "scara"

    def draw(self, rng: np.random.Generator) -> Arm:
        upper, fore = rng.uniform(0.25, 0.5), rng.uniform(0.2, 0.45)
        rows = [
            (upper, 0.0, rng.uniform(0.0, 0.05), 0.0),
            (fore, np.pi, 0.0, 0.0),
            (0.0, 0.0, rng.uniform(0.02, 0.1), 0.0),
            (0.0, 0.0, 0.0, 0.0),
        ]
        return draw_arm(
            "scara",
            rng,
            rows,
            limits=[(-2.2, 2.2), (-2.4, 2.4), (0.0, rng.uniform(0.15, 0.3)), (-6.2, 6.2)],
            masses=[8.0, 5.0, 1.5, 0.3],
            speed=[6.0, 7.0, 1.0, 15.0],
            effort=[150.0, 60.0, 80.0, 10.0],
            slides=(2,),
            height=rng.uniform(0.2, 0.4),
        )


TOPOLOGY = Scara()
