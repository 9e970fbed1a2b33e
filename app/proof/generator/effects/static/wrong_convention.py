"""The recording is written down wrongly: a joint's sign, its zero a quarter turn away, or two joints changed over."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.term import Size, Term, pick


@dataclass(frozen=True)
class WrongConvention:
    """`joint` alone: its sign. With `turn`: its zero. With `source_joint`: the two are changed over."""

    key: str = "wrong_convention"
    places: tuple[str, ...] = ("joint", "source_joint")
    sizes: tuple[Size, ...] = (Size("turn", "rad", "deg"),)

    def draw(self, rng, cell, asked):
        slides, n = cell.arm.slides, cell.arm.n
        joint = pick(rng, asked, "joint", list(range(1, n + 1)), self.key)
        alike = [j + 1 for j in range(n) if j + 1 != joint and slides[j] == slides[joint - 1]]
        # the first and the last zero belong to base and tool
        inner = 1 < joint < n and not slides[joint - 1]
        lot = rng.random()
        if asked.get("sizes"):
            return Term(self.key, {"joint": joint}, {"turn": 0.5 * np.pi}, scalable=False)
        if "source_joint" in asked or (not asked and lot < 0.25 and alike):
            source = pick(rng, asked, "source_joint", alike, self.key)
            where = {"joint": min(joint, source), "source_joint": max(joint, source)}
            return Term(self.key, where, {}, scalable=False)
        if not asked and lot < 0.5 and inner:
            return Term(self.key, {"joint": joint}, {"turn": float(rng.choice([-0.5, 0.5])) * np.pi}, False)
        return Term(self.key, {"joint": joint}, {}, scalable=False)

    def add(self, cell, term, world):
        j = term.where["joint"] - 1
        if "source_joint" in term.where:
            k = term.where["source_joint"] - 1
            world.dq[:, j] += cell.q[:, k] - cell.q[:, j]
            world.dq[:, k] += cell.q[:, j] - cell.q[:, k]
        elif "turn" in term.parameters:
            world.dq[:, j] += term.parameters["turn"]
        else:
            world.flipped[j] *= -1.0

    def shown(self, term, q):
        """(m, n) what is shown where the joints really stand at `q`."""
        q, j = q.copy(), term.where["joint"] - 1
        if "source_joint" in term.where:
            k = term.where["source_joint"] - 1
            q[:, [j, k]] = q[:, [k, j]]
        elif "turn" in term.parameters:
            q[:, j] -= term.parameters["turn"]
        else:
            q[:, j] *= -1.0
        return q


EFFECT = WrongConvention()
