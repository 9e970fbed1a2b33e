"""The controller's gear ratio is off: q_true = (1 + ratio_error) q."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.generator.effects.term import Size, Term, pick


@dataclass(frozen=True)
class GearRatio:
    key: str = "gear_ratio"
    places: tuple[str, ...] = ("joint",)
    sizes: tuple[Size, ...] = (Size("ratio_error", "1"),)

    def draw(self, rng, cell, asked):
        joint = pick(rng, asked, "joint", list(range(1, cell.arm.n + 1)), self.key)
        value = float(rng.choice([-1e-3, 1e-3]))
        return Term(self.key, {"joint": joint, "driver": "own_angle"}, {"ratio_error": value})

    def add(self, cell, term, world):
        j = term.where["joint"] - 1
        world.dq[:, j] += term.parameters["ratio_error"] * cell.q[:, j]


EFFECT = GearRatio()
