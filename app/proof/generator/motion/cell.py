"""What moves, what deviates in it, and what torque that takes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from app import catalog
from app.proof.generator.arm import Arm, point_jacobian, stance
from app.proof.generator.dynamics import GRAVITY, moving_torques
from app.proof.generator.effects.term import Term

LAWS = "app.proof.generator.effects.motion"
OUTSIDE = "app.proof.generator.effects.outside.motion"
STANDSTILL = 2.0e-3  # rad/s or m/s: below, dry friction fades into rest

Path = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray, np.ndarray]]


@dataclass(frozen=True, eq=False)
class Motion:
    """A motion before anything is wrong with it.

    Args:
        arm: as it is; described: as its description has it.
        path: gives position, speed and acceleration (m, n) at any times (m,).
        t: (m,) [s] when samples are taken.
        standstill: speed below which dry friction fades into rest, of all joints or of each (n,) [rad/s or m/s].
        fading: how it does: "tanh" or "arctan".
    """

    arm: Arm
    described: Arm
    path: Path
    t: np.ndarray
    standstill: float | np.ndarray = STANDSTILL
    fading: str = "tanh"

    @property
    def m(self) -> int:
        return len(self.t)

    @cached_property
    def state(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """q, qd, qdd (m, n) at the samples."""
        return self.path(self.t)

    @property
    def q(self) -> np.ndarray:
        return self.state[0]

    @property
    def qd(self) -> np.ndarray:
        return self.state[1]

    @property
    def qdd(self) -> np.ndarray:
        return self.state[2]

    @cached_property
    def rigid(self) -> np.ndarray:
        """(m, n) torque of the arm with nothing wrong [Nm]."""
        return moving_torques(self.arm, *self.state)

    @cached_property
    def direction(self) -> np.ndarray:
        """(m, n) sign of the speed, fading to 0 at standstill."""
        rate = self.qd / self.standstill
        return np.tanh(rate) if self.fading == "tanh" else np.arctan(0.5 * np.pi * rate) * 2.0 / np.pi

    @cached_property
    def warmth(self) -> np.ndarray:
        """(m,) 1 at the start, towards 0: what a warming gear has still before it."""
        return np.exp(-self.t / (0.3 * max(self.t[-1], 1e-9)))

    def later(self, delay: float) -> Motion:
        """The same motion, sampled `delay` earlier: what a late torque shows."""
        return replace(self, t=self.t - delay)


@dataclass(eq=False)
class World:
    """Everything the effects add.

    Args:
        torque: (m, n) on top of rigid bodies [Nm].
        gravity: (3,) [m/s^2] in base.
        loads: masses (m,) [kg] with their place (3,) [m] in the flange, or in the frame of a link (from 0).
        load_friction: (n,) share of the carried torque that rubs.
        gain: (n,) factor on the recorded torque.
        delay: how late torques are recorded [s].
    """

    torque: np.ndarray
    gravity: np.ndarray
    load_friction: np.ndarray
    gain: np.ndarray
    loads: list[tuple[np.ndarray, np.ndarray, int | None]] = field(default_factory=list)
    delay: float = 0.0


def law_of(key: str):
    """A law of the library or from outside it, by key."""
    outside = catalog.members(OUTSIDE, "EFFECT")
    return outside[key] if key in outside else catalog.member(LAWS, "EFFECT", key, what="effect")


def drive_torques(cell: Motion, terms: Sequence[Term]) -> np.ndarray:
    """(m, n) torque recorded without noise [Nm]."""
    late = sum(t.parameters["delay"] for t in terms if t.effect == "delay" and "joint" not in t.where)
    if late:
        cell = cell.later(late)
    n = cell.arm.n
    world = World(np.zeros((cell.m, n)), GRAVITY.copy(), np.zeros(n), np.ones(n))
    for term in terms:
        law_of(term.effect).add(cell, term, world)
    tilted = bool(np.any(world.gravity != GRAVITY))
    rigid = moving_torques(cell.arm, *cell.state, gravity=world.gravity) if tilted else cell.rigid
    carried = rigid
    for mass, at, link in world.loads:
        full = moving_torques(
            cell.arm, *cell.state, gravity=world.gravity, load_kg=1.0, load_at=at, load_link=link
        )
        carried = carried + mass[:, None] * (full - rigid)
    rubbing = world.load_friction * np.abs(carried) * cell.direction
    return (carried + world.torque + rubbing) * world.gain


def wrench_torques(cell: Motion, force: np.ndarray, moment: np.ndarray) -> np.ndarray:
    """(m, n) torque [Nm] while the flange pushes on the world with a force (3,) [N] and turns it with a moment (3,)
    [Nm] about its origin, both in base axes."""
    where = stance(cell.arm, cell.q)
    pushing = np.swapaxes(point_jacobian(cell.arm, where, where.flange_places), 1, 2) @ force
    return pushing + np.where(cell.arm.slides, 0.0, where.axes @ moment)


def effect_on_torques(cell: Motion, terms: Sequence[Term], term: Term) -> np.ndarray:
    """(m, n) what one term does beside the others [Nm]."""
    others = [t for t in terms if t is not term]
    return drive_torques(cell, [*others, term]) - drive_torques(cell, others)


def scaled_to(cell: Motion, terms: Sequence[Term], term: Term, sigma: np.ndarray, ratio: float) -> Term:
    """The term made so strong that, where it acts most, its rms is `ratio` times the noise there.

    Args:
        sigma: (n,) noise of each joint [Nm].
    """
    for _ in range(3):
        moved = effect_on_torques(cell, [*terms, term], term) / sigma
        active = np.abs(moved).max(axis=1) > 1e-9
        size = float(np.sqrt(np.mean(moved[active] ** 2, axis=0)).max()) if active.any() else 0.0
        if size <= 1e-12:
            break
        term = law_of(term.effect).stronger(term, ratio / size)
    return term
