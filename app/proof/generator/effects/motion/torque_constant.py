"""A drive gain that is off: recorded tau = (1 + scale) * tau."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.generator.effects.motion._joint import JointTorque, either_sign, loaded_joints
from app.proof.generator.effects.term import Size


@dataclass(frozen=True)
class TorqueConstant(JointTorque):
    key: str = "torque_constant"
    driver: str = ""
    sizes: tuple[Size, ...] = (Size("scale", "1"),)

    def joints(self, cell):
        return loaded_joints(cell)

    def values(self, rng, cell, j):
        return {"scale": 0.01 * either_sign(rng)}

    def add(self, cell, term, world):
        world.gain[term.where["joint"] - 1] *= 1.0 + term.parameters["scale"]


EFFECT = TorqueConstant()
