"""A link that is heavier than described, with its centre where it was: mass and inertia by one share."""

from __future__ import annotations

from dataclasses import dataclass

from app.proof.generator.dynamics import moving_torques
from app.proof.generator.effects.motion._joint import strengthened
from app.proof.generator.effects.term import Size, Term, pick

SHARE = (0.25, 0.6)  # of the link's mass: more than any description is off by itself


@dataclass(frozen=True)
class LinkInertia:
    key: str = "link_inertia"
    places: tuple[str, ...] = ("link",)
    sizes: tuple[Size, ...] = (Size("mass", "kg", "kg"),)

    def draw(self, rng, cell, asked):
        heavy = [k + 1 for k in range(cell.arm.n) if cell.arm.masses[k] > 0.02 * cell.arm.masses.sum()]
        link = pick(rng, asked, "link", heavy, self.key)
        share = float(rng.uniform(*SHARE) * rng.choice([-1.0, 1.0]))
        return Term(
            self.key, {"link": link}, {"mass": share * float(cell.arm.masses[link - 1])}, scalable=False
        )

    def add(self, cell, term, world):
        k = term.where["link"] - 1
        share = term.parameters["mass"] / cell.arm.masses[k]
        masses, inertias = cell.arm.masses.copy(), cell.arm.inertias.copy()
        masses[k] *= 1.0 + share
        inertias[k] *= 1.0 + share
        heavier = cell.arm.changed(masses=masses, inertias=inertias)
        # what a tilted base changes in this change is of second order
        world.torque += moving_torques(heavier, *cell.state) - cell.rigid

    def stronger(self, term, factor):
        return strengthened(term, factor, ("mass",))


EFFECT = LinkInertia()
