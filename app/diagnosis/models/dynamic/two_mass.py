"""A joint that twists: the motor on one side of a spring with a damper, the link on the other.

With the motor's angle as it was recorded, the twist x (motor less link) follows

    inertia x'' + damping x' + (stiffness + weight) x = u,

u the torque that the link would take if it were fixed to the motor, weight what gravity adds to it per angle.
The spring carries stiffness x + damping x'.

Source: Spong (1987), Modeling and control of elastic joint robots, J. Dyn. Sys. Meas. Control 109(4), eq. (2).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import get_lapack_funcs

(_TBTRS,) = get_lapack_funcs(("tbtrs",), dtype=np.float64)  # scipy.signal would take half a second to load
_CREEPING = (
    40.0  # twenty times the damping at which nothing rings: beyond, what is written down loses its digits
)
#: rad that it turns in a step: below, the difference of its two ways has fewer digits than their common limit.
_SLOW = 1e-6


@dataclass(frozen=True, eq=False)
class Behind:
    """What is behind a joint: values (m,) along its motion, torque [Nm].

    Args:
        rigid: u above.
        inertia: [kg m^2]; weight: [Nm/rad].
    """

    rigid: np.ndarray
    inertia: np.ndarray
    weight: np.ndarray


def twist(
    t: np.ndarray, behind: Behind, stiffness: float, damping: float, runs: Sequence[slice]
) -> tuple[np.ndarray, np.ndarray]:
    """Twist [rad] and its acceleration [rad/s^2], (m,) each; every run begins with the spring at rest under its load.

    Between two samples the load is a line, inertia and weight are their mean: the motion is then written down exactly.

    Args:
        t: (m,) [s].
        stiffness: [Nm/rad]; damping: [Nm s/rad].
        runs: parts of the log without a gap.

    Raises:
        ValueError: a stiffness or a damping that no spring behind such a link has.
    """
    rigid, inertia = behind.rigid, behind.inertia
    holds, lightest = stiffness + behind.weight, float(inertia.min())
    if not holds.min() > 0.0 or not lightest > 0.0:
        raise ValueError(f"stiffness {stiffness:g} does not hold the link")
    if not 0.0 <= damping <= _CREEPING * np.sqrt(holds.min() * lightest):
        raise ValueError(f"damping {damping:g} beside a stiffness of {stiffness:g}")
    m, h = len(t), np.diff(t)
    slope = np.diff(rigid) / h
    own, spring = (0.5 * (v[1:] + v[:-1]) for v in (inertia, holds))
    # On a line a + b s of load, once all ringing is gone: x = (a + b s) / spring - b damping / spring^2.
    behind_by = slope * damping / spring
    begin, end = (np.stack([(load - behind_by) / spring, slope / spring]) for load in (rigid[:-1], rigid[1:]))
    swing = _transition(h, own, spring, damping)
    right = np.zeros((m, 2))
    right[1:] = (end - np.einsum("ijk,jk->ik", swing, begin)).T
    for run in runs:
        right[run.start] = begin[:, min(run.start, m - 2)]
        if run.start:
            swing[:, :, run.start - 1] = 0.0
    # x[n + 1] = swing[n] x[n] + right[n + 1]: a triangular system with three bands.
    band = np.zeros((4, 2 * m))
    band[0] = 1.0
    band[1, 1:-1:2] = -swing[0, 1]
    band[2, 0:-2:2], band[2, 1:-1:2] = -swing[0, 0], -swing[1, 1]
    band[3, 0:-2:2] = -swing[1, 0]
    x, rate = _TBTRS(band, right.reshape(-1, 1), uplo="L")[0].reshape(m, 2).T
    return x, (rigid - damping * rate - holds * x) / inertia


def _transition(h: np.ndarray, inertia: np.ndarray, spring: np.ndarray, damping: float) -> np.ndarray:
    """(2, 2, m) what twist and its rate become over steps h (m,) without a load."""
    decay, own = 0.5 * damping / inertia, spring / inertia
    turn = np.sqrt((own - decay**2).astype(complex))  # imaginary where it creeps back instead of ringing
    # With the decay in the exponents nothing grows beyond what a number holds, however heavily it is damped.
    ahead, behind = np.exp((1j * turn - decay) * h), np.exp((-1j * turn - decay) * h)
    slow = np.abs(turn * h) < _SLOW
    cosine = 0.5 * np.real(ahead + behind)
    sine = np.real(np.where(slow, h * ahead, (ahead - behind) / np.where(slow, 1.0, 2j * turn)))
    return np.array([[cosine + decay * sine, sine], [-own * sine, cosine - decay * sine]])
