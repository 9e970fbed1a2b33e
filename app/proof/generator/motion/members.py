"""What the joints of a real arm have: friction of every kind, rotors, drives, each a little different."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.effects.term import Term
from app.proof.generator.motion.cell import Motion, law_of

RATED = 100.0  # Nm where a description states no effort

#: Families of the error budget by effect. Where the contract names none, it is that of the part the effect comes
#: from: a motor's ripple is its drive's, a spring carries load, and a load taken up is an event.
FAMILY_OF = {
    "gravity_direction": "mounting",
    "link_inertia": "inertials",
    "viscous_friction": "friction",
    "coulomb_friction": "friction",
    "stribeck_friction": "friction",
    "friction_asymmetry": "friction",
    "quadratic_friction": "friction",
    "load_friction": "friction",
    "warmup_friction": "friction",
    "rotor_inertia": "rotors",
    "payload": "load",
    "joint_spring": "load",
    "torque_constant": "drive",
    "torque_ripple": "drive",
    "elastic_joint": "drive",
    "delay": "timing",
    "joint_coupling": "couplings",
    "contact": "events",
    "payload_change": "events",
}


@dataclass(frozen=True)
class Member:
    """One law of the arm; width: one sigma of its strengths, None for the dominant one."""

    term: Term
    width: float | None

    def times(self, factor: float) -> Member:
        law = law_of(self.term.effect)
        return Member(law.stronger(self.term, factor), None if self.width is None else self.width * factor)


@dataclass(frozen=True)
class Drives:
    """How the joints are built: shares of the rated torque, an arm's usual value.

    Args:
        coulomb: dry friction; viscous, quadratic: at the highest speed; stribeck: on top of dry friction near rest, and
            asymmetry: shares of dry friction; load: of the torque carried.
        rotor: at the usual acceleration.
        gain: relative error of each drive's torque.
        coupling: from a wrist's joint to the next, at the highest speed.
    """

    coulomb: float
    viscous: float
    stribeck: float
    asymmetry: float
    quadratic: float
    load: float
    rotor: float
    gain: float
    coupling: float


def draw_drives(rng: np.random.Generator) -> Drives:
    """From a direct drive with good bearings to a harmonic drive that was never run in."""

    def between(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(np.log(low), np.log(high))))

    coulomb = between(0.005, 0.06)
    return Drives(
        coulomb=coulomb,
        viscous=coulomb * between(0.3, 1.5),
        stribeck=float(rng.choice([0.0, 0.3])),
        asymmetry=float(rng.choice([0.0, 0.15])),
        quadratic=float(rng.choice([0.0, 0.0, 0.2])) * coulomb,
        load=float(rng.choice([0.0, 0.02])),
        rotor=between(0.003, 0.03),
        gain=float(rng.choice([0.0, 0.02])),
        coupling=float(rng.choice([0.0, 0.0, 0.3])) * coulomb,
    )


def draw_drive_members(drives: Drives, cell: Motion, rng: np.random.Generator) -> list[Member]:
    """Laws of every joint."""
    out: list[Member] = []
    n = cell.arm.n
    rated = np.where(cell.arm.effort > 0, cell.arm.effort, RATED)
    fast = np.maximum(np.abs(cell.qd).max(axis=0), 0.1)
    quick = np.maximum(np.sqrt(np.mean(cell.qdd**2, axis=0)), 0.1)

    def add(
        effect: str, j: int, driver: str, name: str, size: float, *, signed: bool = False, **shapes: float
    ) -> None:
        if size <= 0.0:
            return
        value = size * (rng.normal() if signed else np.exp(0.5 * rng.normal()))
        where = {"joint": j + 1, **({"driver": driver} if driver else {})}
        out.append(Member(Term(effect, where, {name: float(value), **shapes}), size))

    for j in range(n):
        dry = drives.coulomb * rated[j]
        add("coulomb_friction", j, "speed", "coulomb", dry)
        add("viscous_friction", j, "speed", "viscous", drives.viscous * rated[j] / fast[j])
        slow = float(rng.uniform(0.1, 0.3) * fast[j])
        add("stribeck_friction", j, "speed", "stribeck", drives.stribeck * dry, stribeck_speed=slow)
        add("friction_asymmetry", j, "speed", "offset", drives.asymmetry * dry, signed=True)
        add("quadratic_friction", j, "speed", "quadratic", drives.quadratic * rated[j] / fast[j] ** 2)
        add("load_friction", j, "gravity_torque", "load", drives.load)
        add("rotor_inertia", j, "acceleration", "inertia", drives.rotor * rated[j] / quick[j])
        add("torque_constant", j, "", "scale", drives.gain, signed=True)
    if drives.coupling and n > 2:
        where = {"joint": n, "source_joint": n - 1, "driver": "speed"}
        size = float(drives.coupling * rated[n - 1] / fast[n - 2])
        term = Term("joint_coupling", where, {"coupling": size * float(rng.choice([-1.0, 1.0]))})
        out.append(Member(term, size))
    return out
