"""A wheel out of centre, or oval: q_true = q + s sin(k q) + c cos(k q), k = 1 or 2 waves a turn."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.term import Size, Term, pick

_START_RAD = 0.001  # any size: the draw is scaled to the wanted displacement afterwards


@dataclass(frozen=True)
class GearEccentricity:
    key: str = "gear_eccentricity"
    places: tuple[str, ...] = ("joint", "order")
    sizes: tuple[Size, ...] = (Size("sin", "rad", "deg"), Size("cos", "rad", "deg"))

    def draw(self, rng, cell, asked):
        turning = [j + 1 for j in range(cell.arm.n) if not cell.arm.slides[j]]
        joint = pick(rng, asked, "joint", turning, self.key)
        phase = rng.uniform(0, 2 * np.pi)
        values = {"sin": _START_RAD * float(np.cos(phase)), "cos": _START_RAD * float(np.sin(phase))}
        order = pick(rng, asked, "order", [1, 2], self.key) if "order" in asked else 1
        where = {"joint": joint, "driver": "own_angle", "order": int(order)}
        return Term(self.key, where, values)

    def add(self, cell, term, world):
        j = term.where["joint"] - 1
        q, v = term.where.get("order", 1) * cell.q[:, j], term.parameters
        world.dq[:, j] += v["sin"] * np.sin(q) + v["cos"] * np.cos(q)


EFFECT = GearEccentricity()
