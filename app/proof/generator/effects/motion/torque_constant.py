"""A drive gain that is off: recorded tau = (1 + scale) * tau, in one joint or by one factor in all of them."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.generator.effects.motion._joint import JointTorque, either_sign, loaded_joints
from app.proof.generator.effects.term import Size, Term


@dataclass(frozen=True)
class TorqueConstant(JointTorque):
    key: str = "torque_constant"
    driver: str = ""
    sizes: tuple[Size, ...] = (Size("scale", "1"),)

    def joints(self, cell):
        return loaded_joints(cell)

    def values(self, rng, cell, j):
        return {"scale": 0.01 * either_sign(rng)}

    def draw(self, rng, cell, asked):
        if asked.get("common"):
            return Term(self.key, {}, self.values(rng, cell, 0))
        return super().draw(rng, cell, asked)

    def add(self, cell, term, world):
        which = slice(None) if "joint" not in term.where else term.where["joint"] - 1
        world.gain[which] *= 1.0 + term.parameters["scale"]


EFFECT = TorqueConstant()
