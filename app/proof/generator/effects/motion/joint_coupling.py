"""One joint loads another: tau_joint += coupling * speed, or acceleration, of the source."""

from __future__ import annotations

from dataclasses import dataclass

from app.errors import InputError
from app.proof.generator.effects.motion._joint import either_sign, moving_joints, strengthened
from app.proof.generator.effects.term import Size, Term, pick


@dataclass(frozen=True)
class JointCoupling:
    key: str = "joint_coupling"
    places: tuple[str, ...] = ("joint", "source_joint", "driver")
    sizes: tuple[Size, ...] = (Size("coupling", "Nm s/rad or kg m^2"),)

    def draw(self, rng, cell, asked):
        joint = pick(rng, asked, "joint", list(range(1, cell.arm.n + 1)), self.key)
        sources = [j for j in moving_joints(cell) if j != joint]
        if not sources:
            raise InputError(f"effect {self.key} needs another joint that moves", expected="two joints")
        near = [j for j in sources if abs(j - joint) <= 1]
        source = pick(
            rng, asked, "source_joint", sources if "source_joint" in asked else near or sources, self.key
        )
        driver = pick(rng, asked, "driver", ["speed", "acceleration"], self.key)
        where = {"joint": joint, "source_joint": source, "driver": driver}
        return Term(self.key, where, {"coupling": either_sign(rng)})

    def add(self, cell, term, world):
        j, source = term.where["joint"] - 1, term.where["source_joint"] - 1
        curve = cell.qd if term.where["driver"] == "speed" else cell.qdd
        world.torque[:, j] += term.parameters["coupling"] * curve[:, source]

    def stronger(self, term, factor):
        return strengthened(term, factor, ("coupling",))


EFFECT = JointCoupling()
