"""An arm as real ones are: everywhere a little off. Which deviations, and how wide they are drawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from app.proof.generator.arm import Arm, link_axes
from app.proof.generator.effects.term import Term

LEAST = 0.1  # of the most loaded joint: stiffness is chosen by more than the weight a joint holds
PARALLEL = 1e-6  # sine of the angle below which two axes count as parallel

#: Families of the error budget by effect. Effects that the contract puts into no family are left out.
FAMILY_OF = {
    "joint_zero": "zeros",
    "link_length": "geometry",
    "link_twist": "geometry",
    "joint_compliance": "elasticity",
    "gear_eccentricity": "gears",
    "gear_ratio": "gears",
    "backlash": "play",
    "joint_coupling": "couplings",
    "payload": "load",
    "instrument_scale": "instrument",
    "instrument_zero_shift": "instrument",
    "base_shift": "events",
    "tool_slip": "events",
    "joint_slip": "events",
}


@dataclass(frozen=True)
class Member:
    """One deviation of an arm, with the width it was drawn from (None: drawn by no width, the dominant one)."""

    term: Term
    width: float | None

    def times(self, factor: float) -> Member:
        return Member(self.term.times(factor), None if self.width is None else self.width * factor)


@dataclass(frozen=True)
class Build:
    """How an arm was built: one-sigma sizes of everything that is off.

    Args:
        zeros, twists: [rad]; lengths: [m].
        elasticity: how far a joint gives way under the load it usually holds [rad].
        waves, second_waves: of each gear, one and two a turn [rad].
        play: [rad]; over: share of joints whose controller makes up for more play than there is.
        ratio, coupling: of each gear, and from a wrist's joint to the next.
    """

    zeros: float
    lengths: float
    twists: float
    elasticity: float
    waves: float
    second_waves: float
    play: float
    over: float
    ratio: float
    coupling: float


def draw_build(rng: np.random.Generator) -> Build:
    """From a well-made arm to one that never was calibrated."""

    def between(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(np.log(low), np.log(high))))

    waves = between(0.02e-3, 0.25e-3)
    return Build(
        zeros=between(0.2e-3, 3e-3),
        lengths=between(0.1e-3, 1e-3),
        twists=between(0.1e-3, 1e-3),
        elasticity=between(0.03e-3, 1.0e-3),
        waves=waves,
        second_waves=waves * rng.uniform(0.2, 0.9),
        play=between(0.02e-3, 0.25e-3),
        over=float(rng.choice([0.0, 0.2, 0.5])),
        ratio=between(2e-6, 5e-5),
        coupling=float(rng.choice([0.0, 5e-5])),
    )


def draw_members(build: Build, arm: Arm, load: np.ndarray, rng: np.random.Generator) -> list[Member]:
    """The deviations of an arm of this build; those that are the base's or the tool's by theory are left out.

    Args:
        load: (n,) [Nm] what each joint usually holds; little is never taken for nothing.

    Joint 1's zero and the shift along its axis are the base's; the last joint's zero and all of the last link are the
    tool's; between parallel axes the shift along them is the next link's, and the turn across takes its place
    (Hayati and Mirmirani, 1985).
    """
    n = arm.n
    out = []

    def add(effect: str, where: dict, width: float, names: Sequence[str], *, one_sided: bool = False) -> None:
        if width <= 0.0:
            return
        sizes = width * rng.normal(size=len(names))
        sizes = np.abs(sizes) if one_sided else sizes
        out.append(Member(Term(effect, where, dict(zip(names, map(float, sizes), strict=True))), width))

    for j in range(2, n):
        add("joint_zero", {"joint": j}, build.zeros, ("offset",))
    for link in range(1, n):
        apart = not parallel_after(arm, link)
        add("link_length", {"link": link, "axis": "a"}, build.lengths, ("offset",))
        if link > 1 and apart:
            add("link_length", {"link": link, "axis": "d"}, build.lengths, ("offset",))
        for axis in ("alpha",) if apart else ("alpha", "beta"):
            add("link_twist", {"link": link, "axis": axis}, build.twists, ("angle",))
    load = np.maximum(load, LEAST * load.max())
    for j in range(1, n + 1):
        own, gravity = {"joint": j, "driver": "own_angle"}, {"joint": j, "driver": "gravity_torque"}
        give = build.elasticity / float(load[j - 1])
        add("joint_compliance", gravity, give, ("compliance",), one_sided=True)
        add("gear_eccentricity", {**own, "order": 1}, build.waves, ("sin", "cos"))
        add("gear_eccentricity", {**own, "order": 2}, build.second_waves, ("sin", "cos"))
        add("gear_ratio", own, build.ratio, ("ratio_error",))
        add("backlash", {"joint": j, "driver": "approach"}, build.play, ("gap",), one_sided=True)
        if rng.random() < build.over:
            out[-1] = replace(out[-1], term=out[-1].term.times(-1.0))
    if build.coupling:
        where = {"joint": n, "source_joint": n - 1}
        add("joint_coupling", where, build.coupling, ("coupling",))
    return out


def parallel_after(arm: Arm, link: int) -> bool:
    """True where the joint axes at either end of a link (from 1) are parallel."""
    _, _, z = link_axes(arm, link)
    following = arm.axes[link] if link < arm.n else np.eye(3)[2]
    return float(np.linalg.norm(np.cross(z, arm.rotations[link] @ following))) < PARALLEL
