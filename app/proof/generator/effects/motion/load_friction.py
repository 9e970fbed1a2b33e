"""Friction that grows with the torque a gear carries: tau += load * |tau_rigid| * sign(qd)."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.generator.effects.motion._joint import JointTorque, loaded_joints
from app.proof.generator.effects.term import Size


@dataclass(frozen=True)
class LoadFriction(JointTorque):
    key: str = "load_friction"
    driver: str = "gravity_torque"
    sizes: tuple[Size, ...] = (Size("load", "1"),)

    def joints(self, cell):
        return loaded_joints(cell)

    def add(self, cell, term, world):
        world.load_friction[term.where["joint"] - 1] += term.parameters["load"]


EFFECT = LoadFriction()
