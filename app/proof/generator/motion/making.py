"""Draws a motion, puts the effects in, and records."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from app.proof.generator.arm import Arm
from app.proof.generator.effects.motion.delay import answered_late
from app.proof.generator.effects.term import Request, Term, draw_term
from app.proof.generator.motion.cell import (
    Motion,
    drive_torques,
    effect_on_torques,
    law_of,
    scaled_to,
)
from app.proof.generator.motion.paths import draw_path
from app.proof.generator.noise import draw_noise

RATED = 100.0  # Nm where a description states no effort
ENCODER = 2.0e-6  # rad or m: one step
SPEED_SIGMA = 5.0e-4  # rad/s
GAIN = (6.0, 14.0)  # Nm/A
SPIKE = (8.0, 40.0)  # of the noise


@dataclass(frozen=True)
class MotionPlan:
    """How a log is made.

    Args:
        samples: rows; rate [Hz].
        noise: one-sigma of the torques, as a share of each joint's rated torque.
        noise_kind: see noise.py.
        stated: False leaves the noise out of the header.
        speeds: recorded speed columns.
        currents: motor currents with drive gains instead of torques.
        temperatures: joint temperatures are recorded.
        repeats: the log holds the same trajectory twice.
        jitter: uneven sampling, as a share of the step.
        strength: what an effect does, in units of the noise where it acts most, where it is left open.
        friction: share of rated torque of dry and of viscous friction in every joint (clutter); 0 for none.
        sharpness: (low, high) between which the speed is drawn below which dry friction fades [rad/s], a joint;
            empty: as everywhere. `fading`: see cell.py.
        spikes: share of torque readings that are off by ten sigma or so.
        stale: share of samples that repeat the one before.
        gaps: how many pieces of a few samples are missing.
        staircase: step of the recorded speed [rad/s]; 0 for none.
        brisk: the motion goes in short hard moves from stop to stop; so it does where an effect needs that to show.
    """

    samples: int = 4000
    rate: float = 125.0
    noise: float = 0.003
    noise_kind: str = "gaussian"
    stated: bool = True
    speeds: bool = True
    currents: bool = False
    temperatures: bool = False
    repeats: bool = False
    jitter: float = 0.0
    strength: float = 4.0
    friction: float = 0.0
    sharpness: tuple[float, ...] = ()
    fading: str = "tanh"
    spikes: float = 0.0
    stale: float = 0.0
    gaps: int = 0
    staircase: float = 0.0
    brisk: bool = False


@dataclass(frozen=True, eq=False)
class MadeMotion:
    """A log and all that is true of it.

    Args:
        terms: the effects asked for; `everywhere`: friction of every joint where the plan says so.
        raw_rms: (terms, n) what each does alone [Nm].
        sigma: (n,) noise [Nm].
        q, qd: as recorded; torque: as recorded [Nm].
        gains: (n,) [Nm/A].
        commanded: (m, n) positions that were asked for, or None where the log does not have them.
    """

    plan: MotionPlan
    cell: Motion
    terms: tuple[Term, ...]
    everywhere: tuple[Term, ...]
    raw_rms: np.ndarray
    sigma: np.ndarray
    q: np.ndarray
    qd: np.ndarray
    torque: np.ndarray
    temperature: np.ndarray
    gains: np.ndarray
    commanded: np.ndarray | None = None


def make_motion(
    plan: MotionPlan,
    arm: Arm,
    described: Arm,
    requests: Sequence[Request],
    rng: np.random.Generator,
    *,
    held: Sequence[Term] = (),
) -> MadeMotion:
    """One log.

    Args:
        held: effects that are settled already; they come first.

    Raises:
        InputError: an effect that this arm or log cannot carry.
    """
    wanted = {law_of(one.effect) for one in (*requests, *held)}
    plan = replace(plan, brisk=plan.brisk or any(getattr(law, "brisk", False) for law in wanted))
    cell = draw_motion_cell(plan, arm, described, rng)
    rated = np.where(arm.effort > 0, arm.effort, RATED)
    sigma = plan.noise * rated
    everywhere = _frictions(cell, rated, plan.friction, rng) if plan.friction else []
    terms: list[Term] = list(held)
    for request in requests:
        law = law_of(request.effect)
        term, open_strength = draw_term(request, law, rng, cell)
        if open_strength:
            term = scaled_to(cell, [*everywhere, *terms], term, sigma, plan.strength)
        terms.append(term)
    return record(plan, cell, terms, everywhere, sigma, rng)


def draw_motion_cell(plan: MotionPlan, arm: Arm, described: Arm, rng: np.random.Generator) -> Motion:
    """A motion without effects."""
    m = plan.samples
    path = draw_path(arm, m / plan.rate, rng, repeats=plan.repeats, brisk=plan.brisk)
    t = np.arange(m) / plan.rate
    if plan.jitter:
        t = t + plan.jitter / plan.rate * rng.uniform(-0.5, 0.5, m)
        t = t - t[0]
    cell = Motion(arm, described, path, np.round(t, 6), fading=plan.fading)
    if plan.sharpness:
        low, high = np.log(plan.sharpness)
        cell = replace(cell, standstill=np.exp(rng.uniform(low, high, arm.n)))
    return cell


def record(
    plan: MotionPlan,
    cell: Motion,
    terms: Sequence[Term],
    everywhere: Sequence[Term],
    sigma: np.ndarray,
    rng: np.random.Generator,
    *,
    raw: bool = True,
) -> MadeMotion:
    """The log of a motion with these effects in it.

    Args:
        everywhere: effects that nobody asked for.
        sigma: (n,) noise [Nm].
        raw: also tell what each effect does alone.
    """
    m, n = cell.m, cell.arm.n
    both = [*everywhere, *terms]
    torque = drive_torques(cell, both)
    alone = [
        np.sqrt(np.mean(effect_on_torques(cell, both, term) ** 2, axis=0)) for term in (terms if raw else [])
    ]
    noise = draw_noise(rng, (m, n), 1.0, plan.noise_kind) * sigma
    gains = np.round(rng.uniform(*GAIN, n), 3)
    late = answered_late(terms, n)
    asked = [cell.path(cell.t + s)[0][:, j] for j, s in enumerate(late)] if late.any() else []
    warm = 25.0 + 12.0 * (1.0 - np.exp(-cell.t / (0.4 * m / plan.rate)))
    made = MadeMotion(
        plan=plan,
        cell=cell,
        terms=tuple(terms),
        everywhere=tuple(everywhere),
        raw_rms=np.array(alone).reshape(-1, n),
        sigma=sigma,
        q=ENCODER * np.rint(cell.q / ENCODER),
        qd=cell.qd + SPEED_SIGMA * rng.normal(size=(m, n)),
        torque=torque + noise,
        temperature=warm[:, None] + rng.normal(0, 0.05, (m, n)),
        gains=gains,
        commanded=np.stack(asked, axis=1) if asked else None,
    )
    return dirtied(made, rng) if plan.spikes or plan.stale or plan.gaps or plan.staircase else made


def dirtied(made: MadeMotion, rng: np.random.Generator) -> MadeMotion:
    """The log as a poor recorder keeps it: spikes, samples that repeat the one before, gaps, speeds in steps."""
    plan, (m, n) = made.plan, made.q.shape
    torque, q, qd = made.torque.copy(), made.q.copy(), made.qd.copy()
    wrong = rng.random((m, n)) < plan.spikes
    size = rng.choice([-1.0, 1.0], (m, n)) * rng.uniform(*SPIKE, (m, n))
    torque += wrong * size * made.sigma
    if plan.staircase:
        qd = plan.staircase * np.rint(qd / plan.staircase)
    for i in np.flatnonzero(rng.random(m - 1) < plan.stale) + 1:
        torque[i], q[i], qd[i] = torque[i - 1], q[i - 1], qd[i - 1]
    kept = np.ones(m, bool)
    for _ in range(plan.gaps):
        begin = int(rng.integers(m // 10, m - m // 10))
        kept[begin : begin + int(rng.integers(3, 60))] = False
    cell = replace(made.cell, t=made.cell.t[kept])
    asked = None if made.commanded is None else made.commanded[kept]
    warm = made.temperature[kept]
    return replace(
        made, cell=cell, torque=torque[kept], q=q[kept], qd=qd[kept], temperature=warm, commanded=asked
    )


def _frictions(cell: Motion, rated: np.ndarray, share: float, rng: np.random.Generator) -> list[Term]:
    """Dry and viscous friction in every joint, as real arms have them."""
    out = []
    for j in range(cell.arm.n):
        level = share * rated[j] * rng.uniform(0.5, 1.5)
        fast = max(float(np.abs(cell.qd[:, j]).max()), 0.1)
        where = {"joint": j + 1, "driver": "speed"}
        out.append(Term("coulomb_friction", where, {"coulomb": float(level)}))
        out.append(Term("viscous_friction", where, {"viscous": float(level * rng.uniform(0.3, 1.0) / fast)}))
    return out
