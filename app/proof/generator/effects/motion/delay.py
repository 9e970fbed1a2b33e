"""Torques are recorded late against the positions: tau_recorded(t) = tau(t - delay)."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.generator.effects.term import Size, Term


@dataclass(frozen=True)
class Delay:
    """Put in by `drive_torques`, which samples the motion earlier."""

    key: str = "delay"
    places: tuple[str, ...] = ()
    sizes: tuple[Size, ...] = (Size("delay", "s", "s"),)

    def draw(self, rng, cell, asked):
        return Term(self.key, {"driver": "time"}, {"delay": float(rng.uniform(0.004, 0.025))}, scalable=False)

    def add(self, cell, term, world):
        world.delay += term.parameters["delay"]


EFFECT = Delay()
