"""A load nobody declared: torque sensors carry it, and every joint bends by its declared compliance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.errors import InputError
from app.proof.generator.dynamics import holding_torques
from app.proof.generator.effects.term import Size, Term


@dataclass(frozen=True)
class Payload:
    key: str = "payload"
    places: tuple[str, ...] = ()
    sizes: tuple[Size, ...] = (
        Size("mass", "kg", "kg"),
        Size("com_x", "m", "mm"),
        Size("com_y", "m", "mm"),
        Size("com_z", "m", "mm"),
    )

    def draw(self, rng, cell, asked):
        if cell.compliance is None:
            raise InputError(
                "effect payload needs an arm that bends by a declared compliance", expected="a compliance"
            )
        com = {"com_x": rng.normal(0, 0.03), "com_y": rng.normal(0, 0.03), "com_z": rng.uniform(0.0, 0.12)}
        values = {"mass": float(rng.uniform(1.0, 4.0)), **{k: float(v) for k, v in com.items()}}
        return Term(self.key, {"body": "tool"}, values, scalable=False)

    def add(self, cell, term, world):
        v = term.parameters
        at = np.array([v["com_x"], v["com_y"], v["com_z"]])
        bare = holding_torques(cell.arm, cell.q)
        extra = holding_torques(cell.arm, cell.q, load_kg=v["mass"], load_at=at) - bare
        world.torque += extra
        world.dq -= cell.compliance * extra


EFFECT = Payload()
