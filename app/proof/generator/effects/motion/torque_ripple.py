"""Torque that swings with the joint's angle: tau += sine sin(order q) + cosine cos(order q)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.motion._joint import JointTorque, strengthened
from app.proof.generator.effects.term import Size


@dataclass(frozen=True)
class TorqueRipple(JointTorque):
    key: str = "torque_ripple"
    driver: str = "own_angle"
    sizes: tuple[Size, ...] = (
        Size("sine", "Nm"),
        Size("cosine", "Nm"),
        Size("order", "1/turn"),
    )

    def values(self, rng, cell, j):
        phase = rng.uniform(0, 2 * np.pi)
        # at least two swings over the range, and slow enough for the sampling to see
        least = int(np.ceil(4.0 * np.pi / max(np.ptp(cell.q[:, j]), 1e-3)))
        order = float(rng.integers(max(least, 4), max(least, 4) + 13))
        return {"sine": float(np.cos(phase)), "cosine": float(np.sin(phase)), "order": order}

    def torque(self, cell, j, values):
        angle = values["order"] * cell.q[:, j]
        return values["sine"] * np.sin(angle) + values["cosine"] * np.cos(angle)

    def stronger(self, term, factor):
        return strengthened(term, factor, ("sine", "cosine"))


EFFECT = TorqueRipple()
