"""The tip sinks into what it touches: contact is felt when it is `depth` beyond, along the flange's Z."""

from __future__ import annotations

from dataclasses import dataclass

from app.errors import InputError
from app.proof.generator.effects.term import Size, Term


@dataclass(frozen=True)
class TouchIndentation:
    key: str = "touch_indentation"
    places: tuple[str, ...] = ()
    sizes: tuple[Size, ...] = (Size("depth", "m", "mm"),)

    def draw(self, rng, cell, asked):
        if cell.kind != "touch":
            raise InputError("effect touch_indentation needs touches", expected="--kind touch")
        return Term(self.key, {"body": "tool"}, {"depth": 1e-3})

    def add(self, cell, term, world):
        world.depth += term.parameters["depth"]


EFFECT = TouchIndentation()
