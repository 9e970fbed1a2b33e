"""A link is longer than described, along the common normal (a) or along its joint's axis (d)."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.generator.arm import link_axes
from app.proof.generator.effects.term import Size, Term, pick


@dataclass(frozen=True)
class LinkLength:
    key: str = "link_length"
    places: tuple[str, ...] = ("link", "axis")
    sizes: tuple[Size, ...] = (Size("offset", "m", "mm"),)

    def draw(self, rng, cell, asked):
        link = pick(rng, asked, "link", list(range(1, cell.arm.n + 1)), self.key)
        axis = pick(rng, asked, "axis", ["a", "d"], self.key)
        return Term(self.key, {"link": link, "axis": axis}, {"offset": float(rng.choice([-1e-3, 1e-3]))})

    def add(self, cell, term, world):
        link = term.where["link"]
        x, _, z = link_axes(cell.described, link)
        world.shifts[:, link] += term.parameters["offset"] * (x if term.where["axis"] == "a" else z)


EFFECT = LinkLength()
