"""Torques are recorded late against the positions: tau_recorded(t) = tau(t - delay).

With a joint: that joint answers its command late, q(t) = q_commanded(t - delay).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.motion._joint import moving_joints
from app.proof.generator.effects.term import Size, Term, pick


@dataclass(frozen=True)
class Delay:
    """Put in by `drive_torques`, which samples the motion earlier; commands are written beside the positions."""

    key: str = "delay"
    places: tuple[str, ...] = ("joint",)
    sizes: tuple[Size, ...] = (Size("delay", "s", "s"),)

    def draw(self, rng, cell, asked):
        joint = (
            {"joint": pick(rng, asked, "joint", moving_joints(cell), self.key)} if "joint" in asked else {}
        )
        delay = float(rng.uniform(0.004, 0.025))
        return Term(self.key, {**joint, "driver": "time"}, {"delay": delay}, scalable=False)

    def add(self, cell, term, world):
        if "joint" not in term.where:
            world.delay += term.parameters["delay"]


def answered_late(terms: Sequence[Term], joints: int) -> np.ndarray:
    """(joints,) how long after its command each joint moves [s]."""
    out = np.zeros(joints)
    for term in terms:
        if term.effect == "delay" and "joint" in term.where:
            out[term.where["joint"] - 1] += term.parameters["delay"]
    return out


EFFECT = Delay()
