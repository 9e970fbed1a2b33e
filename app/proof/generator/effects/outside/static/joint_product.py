"""A joint that deviates with the product of its own angle and its neighbour."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.generator.effects.outside.static._along import JointCurve, centred


@dataclass(frozen=True)
class JointProduct(JointCurve):
    key: str = "joint_product"

    def curve(self, cell, j):
        other = j + 1 if j + 1 < cell.arm.n else j - 1
        return centred(cell, j) * centred(cell, other)


EFFECT = JointProduct()
