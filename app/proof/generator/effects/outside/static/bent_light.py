"""Light that bends: the instrument reads a point too low, with the square of its distance."""

from __future__ import annotations

from dataclasses import dataclass

from app.errors import InputError
from app.proof.generator.effects.term import Size, Term


@dataclass(frozen=True)
class BentLight:
    key: str = "bent_light"
    places: tuple[str, ...] = ()
    sizes: tuple[Size, ...] = (Size("bend", "m", "mm"),)

    def draw(self, rng, cell, asked):
        if cell.kind != "tracker":
            raise InputError("effect bent_light: no instrument here", expected="--kind tracker")
        return Term(self.key, {"body": "instrument"}, {"bend": 1e-3})

    def add(self, cell, term, world):
        world.bend += term.parameters["bend"]


EFFECT = BentLight()
