"""The instrument reads too long along its beam (or wire): its zero stands elsewhere, at once or from a row on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from app.errors import InputError
from app.proof.generator.effects.static._step import after, step_row
from app.proof.generator.effects.term import Size, Term


@dataclass(frozen=True)
class InstrumentZeroShift:
    key: str = "instrument_zero_shift"
    places: tuple[str, ...] = ("from_row",)
    sizes: tuple[Size, ...] = (Size("offset", "m", "mm"),)

    def draw(self, rng, cell, asked):
        if cell.kind != "tracker":
            raise InputError("effect instrument_zero_shift: no instrument here", expected="--kind tracker")
        where: dict[str, Any] = {"body": "instrument"}
        if "from_row" in asked:
            where["from_row"] = step_row(rng, cell, asked, self.key)
        return Term(self.key, where, {"offset": float(rng.choice([-1e-3, 1e-3]))})

    def add(self, cell, term, world):
        world.reach += term.parameters["offset"] * after(cell, term.where.get("from_row", 1))


EFFECT = InstrumentZeroShift()
