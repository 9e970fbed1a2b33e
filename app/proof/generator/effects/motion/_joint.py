"""What laws on one joint share."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.term import Size, Term, pick

MOVES = 1.0e-2  # rad/s: a joint that is slower has no friction to show


@dataclass(frozen=True)
class JointTorque:
    """Adds torque to one joint; children give the parameters and the torque."""

    key: str = ""
    driver: str = ""
    places: tuple[str, ...] = ("joint",)
    sizes: tuple[Size, ...] = ()

    def draw(self, rng, cell, asked):
        choices = moving_joints(cell) if "joint" in asked else self.joints(cell)
        joint = pick(rng, asked, "joint", choices, self.key)
        where = {"joint": joint, **({"driver": self.driver} if self.driver else {})}
        return Term(self.key, where, self.values(rng, cell, joint - 1))

    def joints(self, cell) -> list[int]:
        """Joints (from 1) that can show it."""
        return moving_joints(cell)

    def values(self, rng, cell, j: int) -> dict[str, float]:
        """Parameters at a unit strength."""
        return {self.sizes[0].name: 1.0}

    def add(self, cell, term, world):
        j = term.where["joint"] - 1
        world.torque[:, j] += self.torque(cell, j, term.parameters)

    def torque(self, cell, j: int, values) -> np.ndarray:
        """(m,) [Nm]."""
        raise TypeError(f"{type(self).__name__} has no torque")

    def stronger(self, term: Term, factor: float) -> Term:
        """The term `factor` times as strong; what is no strength stays."""
        return strengthened(term, factor, (self.sizes[0].name,))


def strengthened(term: Term, factor: float, names: tuple[str, ...]) -> Term:
    """The term with these parameters multiplied."""
    values = {k: v * factor if k in names else v for k, v in term.parameters.items()}
    return Term(term.effect, term.where, values, term.scalable)


def moving_joints(cell) -> list[int]:
    """Joints (from 1) that move."""
    speed = np.sqrt(np.mean(cell.qd**2, axis=0))
    return [j + 1 for j in range(cell.arm.n) if speed[j] > MOVES]


def loaded_joints(cell) -> list[int]:
    """Joints (from 1) that move and carry torques worth a twentieth of what they are rated for."""
    rated = np.where(cell.arm.effort > 0, cell.arm.effort, 100.0)
    carried = np.sqrt(np.mean(cell.rigid**2, axis=0)) > 0.05 * rated
    return [j for j in moving_joints(cell) if carried[j - 1]]


def either_sign(rng) -> float:
    """Plus or minus one."""
    return float(rng.choice([-1.0, 1.0]))
