"""Joints of which the motor's angle is recorded beside the link's: the twist between them follows the load.

With the link's angle known, its torque tau is known, ringing and all, and the spring and damper that carry it twist by

    motor - link = tau / stiffness - (damping / stiffness^2) tau' + an offset,

to first order in damping over stiffness, a time far shorter than any swing. Least squares; the uncertainty from
stretches of the log, as the residual hangs together.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.diagnosis.models.dynamic.library import laws
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.result import Finding, Parameter
from app.diagnosis.thresholds.elastic import FALLS, SURE
from app.diagnosis.wording import note
from app.estimation import plus_minus

STRETCHES, FOLDS, TURNS = 40, 5, 199


@dataclass(frozen=True)
class Twist:
    """One joint, from 0.

    Args:
        stiffness [Nm/rad], damping [Nm s/rad]: value and standard deviation.
        without, with_it: held-out error of the motor's angle, taken from the link's [rad].
        p_value: of no spring.
    """

    joint: int
    stiffness: tuple[float, float]
    damping: tuple[float, float]
    without: float
    with_it: float
    p_value: float


def twist_findings(state: State) -> tuple[Finding, ...]:
    """As findings: joints whose motor and link turn apart under load. `state` has the masses and loads found in it."""
    law = next((law for law in laws().values() if law.both_sides), None)
    if law is None or state.every is None:
        return ()
    found = (
        _twist(state, j) for j in range(state.joints) if state.every.both_sides(j) and not state.sliding[j]
    )
    return tuple(
        Finding(
            effect=law.key,
            where={"joint": one.joint + 1, "driver": law.both_sides},
            parameters=tuple(
                Parameter(name, *pair, law.units[name])
                for name, pair in (("stiffness", one.stiffness), ("damping", one.damping))
            ),
            visible=1.0,
            p_value=one.p_value,
            heldout_rms_without=one.without,
            heldout_rms_with=one.with_it,
            alternatives=(),
            sentence=(
                f"Joint {one.joint + 1} twists: the angles of motor and link differ by the load over a stiffness of "
                f"{plus_minus(*one.stiffness, 'Nm/rad')}, with a damping of {plus_minus(*one.damping, 'Nm s/rad')}; "
                f"that leaves {one.with_it:.2g} of {one.without:.2g} rad between them."
            ),
            equation=note("law_twist"),
            heldout_unit="rad",
        )
        for one in found
        if one is not None
    )


def _twist(state: State, j: int) -> Twist | None:
    assert state.every is not None
    t = state.t
    apart = state.every.pooled(state.every.apart(j))
    # Torques that are recorded late are those of an earlier motion; the angles are as they are.
    load = np.interp(t + state.hypothesis.delay, t, state.torque[:, j])
    if not np.ptp(load) > 0.0 or not np.ptp(apart) > 0.0:
        return None
    columns = np.stack([load, np.gradient(load, t)], axis=1)
    columns = columns - columns.mean(axis=0)
    rest = apart - apart.mean()
    weights, left, inverse = _solved(columns, rest)
    stretch = np.minimum(np.arange(len(t)) * STRETCHES // len(t), STRETCHES - 1)
    covariance = _sandwich(columns, left, inverse, stretch)
    gives, slope = (float(w) for w in weights)
    std = float(np.sqrt(covariance[0, 0]))
    without, with_it = _heldout(columns[:, :0], rest, stretch), _heldout(columns, rest, stretch)
    if gives < SURE * std or not with_it < FALLS * without:
        return None
    # The null: signs of the stretches turned at random; as many turns as stretches can be told apart by.
    scores = np.bincount(stretch, columns[:, 0] * rest, STRETCHES)
    signs = np.random.default_rng(0).choice([-1.0, 1.0], (TURNS, STRETCHES))
    p = float((1 + np.sum(np.abs(signs @ scores) >= abs(scores.sum()))) / (TURNS + 1))
    stiffness = 1.0 / gives
    damping = max(-slope, 0.0) * stiffness**2
    spread = (std * stiffness**2, float(np.sqrt(covariance[1, 1])) * stiffness**2)
    return Twist(j, (stiffness, spread[0]), (damping, spread[1]), without, with_it, p)


def _solved(columns: np.ndarray, rest: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Weights (k,), residual (M,) and inverse of the normal matrix (k, k)."""
    size = np.maximum(np.sqrt(np.sum(columns**2, axis=0)), 1e-300)
    inverse = np.linalg.pinv(columns.T @ columns / size[:, None] / size) / size[:, None] / size
    weights = inverse @ (columns.T @ rest)
    return weights, rest - columns @ weights, inverse


def _sandwich(columns: np.ndarray, left: np.ndarray, inverse: np.ndarray, stretch: np.ndarray) -> np.ndarray:
    scores = np.stack([np.bincount(stretch, c * left, STRETCHES) for c in columns.T], axis=1)
    return inverse @ (scores.T @ scores) @ inverse * STRETCHES / (STRETCHES - 1)


def _heldout(columns: np.ndarray, rest: np.ndarray, stretch: np.ndarray) -> float:
    """Root mean square on every fifth stretch in turn, the rest of the log fitted."""
    total = 0.0
    for k in range(FOLDS):
        out = stretch % FOLDS == k
        means = columns[~out].mean(axis=0), rest[~out].mean()
        weights, _, _ = _solved(columns[~out] - means[0], rest[~out] - means[1])
        left = rest[out] - means[1] - (columns[out] - means[0]) @ weights
        total += float(left @ left)
    return float(np.sqrt(total / len(rest)))
