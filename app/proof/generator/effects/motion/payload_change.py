"""A load that is taken up at some moment."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.generator.effects.motion._window import start_time, within
from app.proof.generator.effects.motion.payload import LOAD_SIZES, draw_load, load_place
from app.proof.generator.effects.term import Size, Term


@dataclass(frozen=True)
class PayloadChange:
    key: str = "payload_change"
    places: tuple[str, ...] = ("from_s",)
    sizes: tuple[Size, ...] = LOAD_SIZES

    def draw(self, rng, cell, asked):
        where = {"body": "tool", "driver": "time", "from_s": start_time(rng, cell, asked, self.key)}
        return Term(self.key, where, draw_load(rng), scalable=False)

    def add(self, cell, term, world):
        mass = term.parameters["mass"] * within(cell, term.where)
        world.loads.append((mass, load_place(term.parameters), None))


EFFECT = PayloadChange()
