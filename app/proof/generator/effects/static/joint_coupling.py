"""One joint is carried along by another, as in a wrist with nested shafts: q_true = q + coupling * q_source."""

from __future__ import annotations

from dataclasses import dataclass

from app.errors import InputError
from app.proof.generator.effects.term import Size, Term, pick


@dataclass(frozen=True)
class JointCoupling:
    key: str = "joint_coupling"
    places: tuple[str, ...] = ("joint", "source_joint")
    sizes: tuple[Size, ...] = (Size("coupling", "1"),)

    def draw(self, rng, cell, asked):
        joints = list(range(1, cell.arm.n + 1))
        joint = pick(rng, asked, "joint", joints, self.key)
        if len(joints) < 2:
            raise InputError(f"effect {self.key} needs two joints", expected="an arm with more than one")
        # A shaft that carries another lies next to it; farther ones are rare.
        near = [j for j in joints if 0 < abs(j - joint) <= 1] or [j for j in joints if j != joint]
        choices = [j for j in joints if j != joint] if "source_joint" in asked else near
        source = pick(rng, asked, "source_joint", choices, self.key)
        where = {"joint": joint, "source_joint": source}
        return Term(self.key, where, {"coupling": float(rng.choice([-1e-3, 1e-3]))})

    def add(self, cell, term, world):
        j, source = term.where["joint"] - 1, term.where["source_joint"] - 1
        world.dq[:, j] += term.parameters["coupling"] * cell.q[:, source]


EFFECT = JointCoupling()
