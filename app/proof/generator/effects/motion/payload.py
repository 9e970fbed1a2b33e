"""A load that the description does not have, on the flange or on another link where that is asked for."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.term import Size, Term, pick

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
    places: tuple[str, ...] = ("link",)
    sizes: tuple[Size, ...] = LOAD_SIZES

    def draw(self, rng, cell, asked):
        if "link" not in asked:
            return Term(self.key, {"body": "tool"}, draw_load(rng), scalable=False)
        link = pick(rng, asked, "link", list(range(1, cell.arm.n)), self.key)
        return Term(self.key, {"link": link}, _draw_load_on(cell.arm, link - 1, rng), scalable=False)

    def add(self, cell, term, world):
        mass = np.full(cell.m, term.parameters["mass"])
        link = term.where["link"] - 1 if "link" in term.where else None
        world.loads.append((mass, load_place(term.parameters), link))


def _draw_load_on(arm, link: int, rng) -> dict[str, float]:
    """A body fastened to the side of a link (from 0), off the link's own centre; its place in the link's frame."""
    along = rng.uniform(0.2, 0.9) * arm.translations[link + 1]
    side = rng.normal(size=3)
    at = along + rng.uniform(0.06, 0.15) * side / np.linalg.norm(side)
    com = {f"com_{c}": float(v) for c, v in zip("xyz", at, strict=True)}
    return {"mass": float(rng.uniform(1.0, 5.0)), **com}


EFFECT = Payload()
