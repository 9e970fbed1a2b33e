"""A link is twisted against its description, about the common normal (alpha) or across it (beta)."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.generator.arm import link_axes
from app.proof.generator.effects.term import Size, Term, pick


@dataclass(frozen=True)
class LinkTwist:
    key: str = "link_twist"
    places: tuple[str, ...] = ("link", "axis")
    sizes: tuple[Size, ...] = (Size("angle", "rad", "deg"),)

    def draw(self, rng, cell, asked):
        link = pick(rng, asked, "link", list(range(1, cell.arm.n + 1)), self.key)
        axis = pick(rng, asked, "axis", ["alpha", "beta"], self.key)
        return Term(self.key, {"link": link, "axis": axis}, {"angle": float(rng.choice([-1e-3, 1e-3]))})

    def add(self, cell, term, world):
        link = term.where["link"]
        x, y, _ = link_axes(cell.described, link)
        world.turns[:, link] += term.parameters["angle"] * (x if term.where["axis"] == "alpha" else y)


EFFECT = LinkTwist()
