"""A joint's zero wanders with time: q_true = q + rate * time."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.generator.effects.term import Size, Term, pick


@dataclass(frozen=True)
class JointDrift:
    key: str = "joint_drift"
    places: tuple[str, ...] = ("joint",)
    sizes: tuple[Size, ...] = (Size("rate", "rad/s", "deg"),)

    def draw(self, rng, cell, asked):
        joint = pick(rng, asked, "joint", list(range(1, cell.arm.n + 1)), self.key)
        value = float(rng.choice([-1e-6, 1e-6]))
        return Term(self.key, {"joint": joint, "driver": "time"}, {"rate": value})

    def add(self, cell, term, world):
        world.dq[:, term.where["joint"] - 1] += term.parameters["rate"] * (cell.t - cell.t[0])


EFFECT = JointDrift()
