"""A joint's zero stands elsewhere than the controller believes: q_true = q + offset."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.generator.effects.term import Size, Term, pick


@dataclass(frozen=True)
class JointZero:
    key: str = "joint_zero"
    places: tuple[str, ...] = ("joint",)
    sizes: tuple[Size, ...] = (Size("offset", "rad", "deg"),)

    def draw(self, rng, cell, asked):
        joint = pick(rng, asked, "joint", list(range(1, cell.arm.n + 1)), self.key)
        return Term(self.key, {"joint": joint}, {"offset": float(rng.choice([-1e-3, 1e-3]))})

    def add(self, cell, term, world):
        world.dq[:, term.where["joint"] - 1] += term.parameters["offset"]


EFFECT = JointZero()
