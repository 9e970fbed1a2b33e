"""A load on the flange that the description does not have."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.term import Size, Term

LOAD_SIZES = (
    Size("mass", "kg", "kg"),
    Size("com_x", "m", "mm"),
    Size("com_y", "m", "mm"),
    Size("com_z", "m", "mm"),
)


def draw_load(rng) -> dict[str, float]:
    """A mass with its centre in front of the flange."""
    com = {"com_x": rng.normal(0, 0.03), "com_y": rng.normal(0, 0.03), "com_z": rng.uniform(0.02, 0.12)}
    return {"mass": float(rng.uniform(0.5, 4.0)), **{k: float(v) for k, v in com.items()}}


def load_place(values) -> np.ndarray:
    """(3,) in the flange [m]."""
    return np.array([values["com_x"], values["com_y"], values["com_z"]])


@dataclass(frozen=True)
class Payload:
    key: str = "payload"
    places: tuple[str, ...] = ()
    sizes: tuple[Size, ...] = LOAD_SIZES

    def draw(self, rng, cell, asked):
        return Term(self.key, {"body": "tool"}, draw_load(rng), scalable=False)

    def add(self, cell, term, world):
        world.loads.append((np.full(cell.m, term.parameters["mass"]), load_place(term.parameters)))


EFFECT = Payload()
