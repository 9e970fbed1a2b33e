"""A deviation of one joint that follows some curve of the rows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.term import Size, Term, pick


@dataclass(frozen=True)
class JointCurve:
    """q_true = q + amplitude * curve; children say which curve."""

    key: str = ""
    places: tuple[str, ...] = ("joint",)
    sizes: tuple[Size, ...] = (Size("amplitude", "rad", "deg"),)

    def joints(self, cell) -> list[int]:
        return [j + 1 for j in range(cell.arm.n) if not cell.arm.slides[j]]

    def draw(self, rng, cell, asked):
        joint = pick(rng, asked, "joint", self.joints(cell), self.key)
        return Term(self.key, {"joint": joint}, {"amplitude": float(rng.choice([-1e-3, 1e-3]))})

    def add(self, cell, term, world):
        j = term.where["joint"] - 1
        world.dq[:, j] += term.parameters["amplitude"] * self.curve(cell, j)

    def curve(self, cell, j: int) -> np.ndarray:
        raise TypeError(f"{type(self).__name__} has no curve")


def centred(cell, j: int) -> np.ndarray:
    """(m,) own angle from the middle of its range, in units of half that range."""
    q = cell.q[:, j]
    return (q - 0.5 * (q.max() + q.min())) / max(0.5 * np.ptp(q), 1e-9)
