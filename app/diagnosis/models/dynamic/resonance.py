"""Does a joint's torque ring as a link on a spring would? First a quick look at spectra, then a search over time.

A link of inertia J on a spring multiplies the torque of a rigid joint, at the angular frequency w, by

    (stiffness + i w damping) / (stiffness + i w damping - J w^2).

The look compares, stretch by stretch (J is another in each), what the measured torque has beyond the rigid one with
what such a factor would add, in the octave to either side of each resonance that is tried. Only where that speaks for
a resonance is the two-mass equation solved, many times, beside everything a rigid joint may have.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from scipy.optimize import minimize

from app.diagnosis.models.dynamic.state import State
from app.diagnosis.models.dynamic.two_mass import Behind, twist
from app.diagnosis.thresholds.elastic import (
    A_PERIOD,
    DAMPED,
    FOUND,
    HEARD,
    KNOWN_DAMPING,
    KNOWN_STIFFNESS,
    SHARE,
    SLOWEST,
)
from app.kinematics.dynamics import PER_LINK

STRETCH = 2.5  # s of a stretch: many swings, and little change of the inertia
SPACING = 0.1  # nepers between the resonances that are tried in the look
LOOSE = 0.1  # damping of those, as a share of the damping at which nothing rings
AROUND = np.linspace(-0.3, 0.3, 13)  # nepers around a resonance that the search begins at
RATIOS = (0.02, 0.06, 0.15, 0.35)  # dampings there, in the same shares
GOES_ON = 60  # steps of the search


@dataclass(frozen=True)
class Resonance:
    """A joint that twists.

    Args:
        stiffness [Nm/rad], damping [Nm s/rad].
        inertia: mean of the described link's over the log [kg m^2]; 0 where the description has no masses: then
            stiffness and damping are per kg m^2.
    """

    stiffness: float
    damping: float
    inertia: float


def resonance_of(state: State, joint: int) -> Resonance | None:
    """What rings behind a joint (from 0), or None."""
    if state.every is None or state.sliding[joint] or not state.moves(joint):
        return None
    if state.every.both_sides(joint):  # the angle is the link's
        return None
    key = ("resonance", joint, state.hypothesis.key)
    if key not in state.memory:
        state.memory[key] = _found(state, joint)
    return state.memory[key]


def _found(state: State, joint: int) -> Resonance | None:
    every = state.every
    assert every is not None
    measured = every.pooled(every.measured(joint))
    if np.ptp(state.torque[:, joint]) > 0.0:
        rigid, inertia = state.torque[:, joint], every.inertia(joint, STRETCH / 10.0)[:, joint]
    else:  # what the masses must give, whatever they are, behind a link of 1 kg m^2
        rigid, inertia = _fitted_rigid(state, joint, measured), np.ones(len(state.t))
    step = float(np.median(np.diff(state.t))) if len(state.t) > 1 else 0.0
    fastest = 1.0 / (A_PERIOD * step) if step > 0.0 else 0.0
    if fastest <= SLOWEST or np.ptp(rigid) <= 0.0 or not inertia.min() > 0.0:
        return None
    heard = _heard(measured - rigid, rigid, inertia, step, fastest)
    if heard is None:
        return None
    if np.ptp(state.torque[:, joint]) > 0.0:
        inertia = every.inertia(joint)[:, joint]
        behind = Behind(rigid, inertia, every.weight(joint)[:, joint])
        return _searched(state, joint, measured, behind, heard, fastest)
    found = _searched(state, joint, measured, Behind(rigid, inertia, np.zeros(len(rigid))), heard, fastest)
    return None if found is None else replace(found, inertia=0.0)


def _heard(
    left: np.ndarray, rigid: np.ndarray, inertia: np.ndarray, step: float, fastest: float
) -> float | None:
    """The resonance [Hz], at the mean inertia, that the spectra speak for most; None where they do not."""
    size = min(max(32, round(STRETCH / step)), len(left))
    begins = np.arange(0, len(left) - size + 1, max(1, size // 2))
    index = begins[:, None] + np.arange(size)
    fade = np.hanning(size)
    parts = [np.fft.rfft(fade * (v[index] - v[index].mean(axis=1, keepdims=True))) for v in (left, rigid)]
    frequency = np.fft.rfftfreq(size, step)
    faster = np.sqrt(inertia.mean() / inertia[index].mean(axis=1))  # a lighter link rings faster
    best: tuple[float, float] | None = None
    count = int(np.log(fastest / SLOWEST) / SPACING) + 1
    for tried in SLOWEST * np.exp(SPACING * np.arange(count)):
        low, high = np.searchsorted(frequency, [tried / 2.0, min(2.0 * tried, 0.45 / step)])
        rest, load = (p[:, low:high] for p in parts)
        turn = frequency[low:high] / (tried * faster[:, None])
        more = load * turn**2 / (1.0 - turn**2 + 2j * LOOSE * turn)
        gain, part = _gain(rest, load, more)
        if SHARE[0] / 2.0 < part < SHARE[1] * 2.0 and gain > (HEARD if best is None else best[0]):
            best = gain, float(tried)
    return None if best is None else best[1]


def _gain(rest: np.ndarray, load: np.ndarray, more: np.ndarray) -> tuple[float, float]:
    """nats by which `more` explains the rest beside the load, and its weight. Stretches overlap: half of them count."""

    def times(a: np.ndarray, b: np.ndarray) -> float:
        return float(np.vdot(a, b).real)

    own = max(times(load, load), 1e-300)
    cross = times(load, more)
    free = times(more, more) - cross**2 / own
    if free <= 1e-9 * times(more, more):
        return 0.0, 0.0
    total = times(rest, rest) - times(load, rest) ** 2 / own
    right = times(more, rest) - cross * times(load, rest) / own
    left = max(total - right**2 / free, 1e-12 * total)
    return 0.5 * rest.size * float(np.log(total / left)) if total > 0.0 else 0.0, right / free


def _searched(
    state: State, joint: int, measured: np.ndarray, behind: Behind, heard: float, fastest: float
) -> Resonance | None:
    """Stiffness and damping that explain the torque best over time."""
    rigid, inertia, mean = behind.rigid, behind.inertia, float(behind.inertia.mean())
    basis = _rigid_joint(state, joint)
    runs = _runs(state.t)

    def beyond(values: np.ndarray) -> np.ndarray:
        return values - basis @ (basis.T @ values)

    def twisted(log_turn: float, log_ratio: float) -> np.ndarray:
        stiffness = mean * float(np.exp(2.0 * log_turn))
        damping = 2.0 * float(np.exp(log_ratio)) * np.sqrt(stiffness * mean)
        turned, push = twist(state.t, behind, stiffness, damping, runs)
        return beyond(-inertia * push - behind.weight * turned)

    left = beyond(measured - rigid)
    total = float(left @ left)
    slow, fast = np.log(2.0 * np.pi * SLOWEST), np.log(2.0 * np.pi * fastest)

    def rest(at: np.ndarray) -> float:
        if not slow <= at[0] <= fast or not np.log(1e-3) <= at[1] <= np.log(2.0):
            return 1.0
        if mean * np.exp(2.0 * at[0]) <= -behind.weight.min():
            return 1.0
        column = twisted(*at)
        return 1.0 - float(column @ left) ** 2 / max(float(column @ column) * total, 1e-300)

    middle = float(np.log(2.0 * np.pi * heard))
    start = min((np.array([middle + a, np.log(r)]) for a in AROUND for r in RATIOS), key=rest)
    simplex = start + np.array([[0.0, 0.0], [0.02, 0.0], [0.0, 0.3]])
    options = {"maxiter": GOES_ON, "initial_simplex": simplex, "xatol": 1e-3, "fatol": 1e-9}
    at = minimize(rest, start, method="Nelder-Mead", options=options).x
    column = twisted(*at)
    part = float(column @ left) / max(float(column @ column), 1e-300)
    gain = -0.5 * len(left) * float(np.log(max(rest(at), 1e-300)))
    stiffness = mean * float(np.exp(2.0 * at[0]))
    ratio = float(np.exp(at[1]))
    if gain < FOUND or not SHARE[0] < part < SHARE[1] or ratio > DAMPED:
        return None
    unsure = _unsure(twisted, at, part, left)
    if unsure[0] > KNOWN_STIFFNESS or unsure[1] > KNOWN_DAMPING:
        return None
    return Resonance(stiffness, 2.0 * ratio * float(np.sqrt(stiffness * mean)), mean)


def _unsure(twisted, at: np.ndarray, part: float, left: np.ndarray) -> tuple[float, float]:
    """Nepers of standard deviation of stiffness and damping, the noise white."""
    slopes = []
    for k, step in enumerate((1e-3, 1e-2)):
        move = np.zeros(2)
        move[k] = step
        slopes.append(part * (twisted(*(at + move)) - twisted(*(at - move))) / (2.0 * step))
    columns = np.stack([twisted(*at), *slopes], axis=1)
    noise = float(np.mean((left - part * columns[:, 0]) ** 2))
    gram = columns.T @ columns
    size = np.sqrt(np.maximum(np.diag(gram), 1e-300))
    covariance = noise * np.linalg.pinv(gram / size[:, None] / size, rcond=1e-10) / size[:, None] / size
    spread = np.sqrt(np.maximum(np.diag(covariance), 0.0))
    return 2.0 * float(spread[1]), float(spread[2])


def _fitted_rigid(state: State, joint: int, measured: np.ndarray) -> np.ndarray:
    """(M,) torque of the masses that explain the measured one best beside friction and an offset [Nm]."""
    qd = state.qd[:, joint]
    masses = state.regressor[:, joint, PER_LINK * joint :]
    columns = np.column_stack([masses, np.ones(len(qd)), qd, qd * np.abs(qd), state.direction(joint)])
    size = np.maximum(np.sqrt(np.mean(columns**2, axis=0)), 1e-12)
    weights = np.linalg.lstsq(columns / size, measured, rcond=1e-8)[0] / size
    return masses @ weights[: masses.shape[1]]


def _rigid_joint(state: State, joint: int) -> np.ndarray:
    """(M, k) orthonormal columns of everything that a rigid joint may have: masses, friction, rotor, an offset."""
    qd = state.qd[:, joint]
    own = [np.ones(len(qd)), qd, qd * np.abs(qd), state.qdd[:, joint], state.direction(joint)]
    columns = np.hstack([state.regressor[:, joint, PER_LINK * joint :], np.stack(own, axis=1)])
    size = np.sqrt(np.mean(columns**2, axis=0))
    basis, triangle = np.linalg.qr(columns[:, size > 1e-12] / size[size > 1e-12])
    return basis[:, np.abs(np.diag(triangle)) > 1e-7 * np.sqrt(len(qd))]


def _runs(t: np.ndarray) -> list[slice]:
    """Windows without a gap between them."""
    wide = np.diff(t)
    edges = [0, *(np.flatnonzero(wide > 1.5 * np.median(wide)) + 1).tolist(), len(t)]
    return [slice(a, b) for a, b in pairwise(edges)]
