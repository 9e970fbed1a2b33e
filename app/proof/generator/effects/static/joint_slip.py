"""A belt jumped or a coupling slipped: from one row on the joint is off by a step."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.generator.effects.static._step import after, step_row
from app.proof.generator.effects.term import Size, Term, pick


@dataclass(frozen=True)
class JointSlip:
    key: str = "joint_slip"
    places: tuple[str, ...] = ("joint", "from_row")
    sizes: tuple[Size, ...] = (Size("step", "rad", "deg"),)

    def draw(self, rng, cell, asked):
        joint = pick(rng, asked, "joint", list(range(1, cell.arm.n + 1)), self.key)
        row = step_row(rng, cell, asked, self.key)
        return Term(self.key, {"joint": joint, "from_row": row}, {"step": float(rng.choice([-1e-3, 1e-3]))})

    def add(self, cell, term, world):
        world.dq[:, term.where["joint"] - 1] += term.parameters["step"] * after(cell, term.where["from_row"])


EFFECT = JointSlip()
