"""The instrument's metre is not one: what it measures is (1 + scale_error) of what is there."""

from __future__ import annotations

from dataclasses import dataclass

from app.errors import InputError
from app.proof.generator.effects.term import Size, Term


@dataclass(frozen=True)
class InstrumentScale:
    key: str = "instrument_scale"
    places: tuple[str, ...] = ()
    sizes: tuple[Size, ...] = (Size("scale_error", "1"),)

    def draw(self, rng, cell, asked):
        if cell.kind == "touch" and not cell.targets_known:
            raise InputError(
                "effect instrument_scale: nothing is measured here", expected="known targets or a tracker"
            )
        return Term(self.key, {"body": "instrument"}, {"scale_error": float(rng.choice([-1e-3, 1e-3]))})

    def add(self, cell, term, world):
        world.scale *= 1.0 + term.parameters["scale_error"]


EFFECT = InstrumentScale()
