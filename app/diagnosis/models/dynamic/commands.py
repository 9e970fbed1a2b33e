"""How late the arm answers its commands, joint by joint, where commanded positions are recorded.

The measured position is held against the commanded one some time earlier; the time, with a constant beside it,
is found by Gauss-Newton, its uncertainty from stretches of the log (they hang together far longer than noise).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.diagnosis.models.dynamic.library import laws
from app.diagnosis.observations.joint_log import Log
from app.diagnosis.result import Finding, Parameter
from app.diagnosis.thresholds.commands import FALLS, LATEST, LEAST, MOVED, SURE
from app.diagnosis.wording import note

STRETCHES = 40
ITERATIONS = 8


@dataclass(frozen=True)
class Lag:
    """One joint.

    Args:
        seconds, std: how late, and how sure.
        without, with_it: held-out error of the position [rad or m].
        p_value: of no lag.
    """

    joint: int
    seconds: float
    std: float
    without: float
    with_it: float
    p_value: float


def lags(log: Log) -> list[Lag]:
    """Joints that answer late (or are recorded so), from 0."""
    if log.commanded is None:
        return []
    found = (_lag(log, j) for j in range(log.q.shape[1]))
    return [lag for lag in found if lag is not None]


def lag_findings(log: Log, sliding: np.ndarray) -> tuple[Finding, ...]:
    """As findings: the lateness of a joint against its command."""
    law = next(law for law in laws().values() if law.follows_commands)
    (name,) = law.linear
    return tuple(
        Finding(
            effect=law.key,
            where={"joint": lag.joint + 1, "driver": law.driver},
            parameters=(Parameter(name, lag.seconds, lag.std, law.units[name]),),
            visible=1.0,
            p_value=lag.p_value,
            heldout_rms_without=lag.without,
            heldout_rms_with=lag.with_it,
            alternatives=(),
            sentence=_sentence(lag, "m" if sliding[lag.joint] else "rad"),
            equation=note("law_command_delay"),
            heldout_unit="m" if sliding[lag.joint] else "rad",
        )
        for lag in lags(log)
    )


def _sentence(lag: Lag, unit: str) -> str:
    late = lag.seconds > 0
    said = "answers its command {:.4g} s late" if late else "is recorded {:.4g} s ahead of its command"
    return (
        f"Joint {lag.joint + 1} {said.format(abs(lag.seconds))}: the commanded position, that much "
        f"{'later' if late else 'earlier'}, misses the measured one by {lag.with_it:.2g} instead of "
        f"{lag.without:.2g} {unit}."
    )


def _lag(log: Log, j: int) -> Lag | None:
    assert log.commanded is not None
    t, q, command = log.t, log.q[:, j], log.commanded[:, j]
    inside = np.zeros(len(t), bool)
    for part in log.segments:  # a shifted command must come from the same run
        keep = max(1, min(int(LATEST / log.step), (part.stop - part.start) // 8))
        inside[part.start + keep : part.stop - keep] = True
    if not inside.any() or min(np.ptp(command[inside]), np.ptp(q[inside])) < MOVED:
        return None
    stretch = np.minimum(np.arange(len(t)) * STRETCHES // len(t), STRETCHES - 1)[inside]
    delay = _coarse(log, q, command)
    for _ in range(ITERATIONS):
        rest, slope = _against(t, q, command, delay, inside)
        step = float(slope @ rest) / max(float(slope @ slope), 1e-300)
        delay = float(np.clip(delay - step, -LATEST, LATEST))
        if abs(step) < 1e-7:
            break
    rest, slope = _against(t, q, command, delay, inside)
    if not slope.any():  # that much earlier the command stood still
        return None
    scores = np.bincount(stretch, slope * rest, STRETCHES)
    std = float(np.sqrt(np.sum(scores**2) * STRETCHES / (STRETCHES - 1)) / (slope @ slope))
    none, _ = _against(t, q, command, 0.0, inside)
    floor = 1e-9 * np.ptp(q)
    if abs(delay) < max(SURE * std, LEAST * log.step) or not np.std(rest) + floor < FALLS * np.std(none):
        return None
    # The null: signs of the stretches turned at random; as many turns as stretches can be told apart by.
    signs = np.random.default_rng(0).choice([-1.0, 1.0], (199, STRETCHES))
    first = np.bincount(stretch, _against(t, q, command, 0.0, inside)[1] * none, STRETCHES)
    p = float((1 + np.sum(np.abs(signs @ first) >= abs(first.sum()))) / 200)
    without, with_it = _heldout(none, None, stretch), _heldout(rest, slope, stretch)
    return Lag(j, delay, std, without, with_it, p) if p <= 0.01 and with_it < without else None


def _coarse(log: Log, q: np.ndarray, command: np.ndarray) -> float:
    """The whole number of samples by which the command's slope fits best."""
    part = max(log.segments, key=lambda s: s.stop - s.start)
    a, b = np.diff(q[part]), np.diff(command[part])
    most = min(int(LATEST / log.step), len(a) // 4)
    size = 1 << (2 * len(a) - 1).bit_length()
    both = np.fft.irfft(np.fft.rfft(a, size) * np.conj(np.fft.rfft(b, size)), size)
    shifts = np.arange(-most, most + 1)
    return float(shifts[int(np.argmax(both[shifts]))] * log.step)


def _against(t: np.ndarray, q: np.ndarray, command: np.ndarray, delay: float, inside: np.ndarray):
    """Position less the command `delay` earlier, and its slope by the delay; both without their mean."""
    slope = np.gradient(command, t)
    rest = (q - np.interp(t - delay, t, command))[inside]
    by = np.interp(t - delay, t, slope)[inside]
    return rest - rest.mean(), by - by.mean()


def _heldout(rest: np.ndarray, slope: np.ndarray | None, stretch: np.ndarray) -> float:
    """Root mean square on every fifth stretch in turn, the lag refitted on the others."""
    total = 0.0
    for k in range(5):
        out = stretch % 5 == k
        left = rest[out] - rest[~out].mean()
        if slope is not None:
            step = float(slope[~out] @ rest[~out]) / max(float(slope[~out] @ slope[~out]), 1e-300)
            left = left - step * slope[out]
        total += float(left @ left)
    return float(np.sqrt(total / len(rest)))
