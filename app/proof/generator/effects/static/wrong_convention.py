"""One joint is written down with the wrong sign: q_true = -q."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.generator.effects.term import Size, Term, pick


@dataclass(frozen=True)
class WrongConvention:
    key: str = "wrong_convention"
    places: tuple[str, ...] = ("joint",)
    sizes: tuple[Size, ...] = ()

    def draw(self, rng, cell, asked):
        joint = pick(rng, asked, "joint", list(range(1, cell.arm.n + 1)), self.key)
        return Term(self.key, {"joint": joint}, {}, scalable=False)

    def add(self, cell, term, world):
        world.flipped[term.where["joint"] - 1] *= -1.0


EFFECT = WrongConvention()
