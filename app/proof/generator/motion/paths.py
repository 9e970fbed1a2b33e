"""Trajectories that excite an arm, with exact speed and acceleration at any time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.proof.generator.arm import Arm, stance
from app.proof.generator.static.poses import comfortable

SPEED = 0.75  # of a joint's limit
RATED_SPEED = 2.0  # rad/s where a description states none
SOFT = 6.0  # rad/s^2, a usual peak acceleration
HARD = 15.0  # rad/s^2, that of a light arm in a hurry
FAR, SHORT = 0.35, 0.12  # of a joint's range, the way from stop to stop at most
FLOOR = -0.05  # m


@dataclass(frozen=True, eq=False)
class FourierPath:
    """Sums of sines, the usual exciting trajectory.

    Args:
        middle: (n,).
        sines, cosines: (n, h) amplitudes of harmonics 1..h.
        pace: 2 pi over the period [rad/s].

    Source: Swevers et al. (1997), Optimal robot excitation and identification.
    """

    middle: np.ndarray
    sines: np.ndarray
    cosines: np.ndarray
    pace: float

    def __call__(self, t: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        order = self.pace * np.arange(1, self.sines.shape[1] + 1)
        s, c = np.sin(np.outer(t, order)), np.cos(np.outer(t, order))
        q = self.middle + s @ self.sines.T + c @ self.cosines.T
        qd = (c * order) @ self.sines.T - (s * order) @ self.cosines.T
        qdd = -(s * order**2) @ self.sines.T - (c * order**2) @ self.cosines.T
        return q, qd, qdd


@dataclass(frozen=True, eq=False)
class StopPath:
    """From stop to stop along fifth-order polynomials, with a rest at every stop.

    Args:
        stops: (k, n) positions.
        leave: (k - 1,) when each move begins [s]; `last`: (k - 1,) how long it takes.
    """

    stops: np.ndarray
    leave: np.ndarray
    last: np.ndarray

    def __call__(self, t: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        move = np.clip(np.searchsorted(self.leave, t, side="right") - 1, 0, len(self.leave) - 1)
        long = self.last[move]
        u = np.clip((t - self.leave[move]) / long, 0.0, 1.0)
        way = (self.stops[move + 1] - self.stops[move]) * 1.0
        place = u**3 * (10.0 - 15.0 * u + 6.0 * u**2)
        rate = 30.0 * u**2 * (1.0 - u) ** 2 / long
        change = 60.0 * u * (1.0 - u) * (1.0 - 2.0 * u) / long**2
        return self.stops[move] + place[:, None] * way, rate[:, None] * way, change[:, None] * way


def draw_path(
    arm: Arm, seconds: float, rng: np.random.Generator, *, repeats: bool, brisk: bool = False
) -> FourierPath | StopPath:
    """A trajectory within limits of place and speed; `repeats` runs the same period twice over, `brisk` goes in
    short hard moves from stop to stop."""
    if brisk:
        return _stops(arm, seconds, rng, HARD, SHORT)
    if rng.random() < 0.7 or repeats:
        return _fourier(arm, seconds / 2.0 if repeats else rng.uniform(0.45, 1.0) * seconds, rng)
    return _stops(arm, seconds, rng)


def _limits(arm: Arm) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    low, high = comfortable(arm)
    top = SPEED * np.where(arm.speed > 0, arm.speed, RATED_SPEED)
    return low, high, np.minimum(top, np.where(arm.slides, 0.5, 2.5)), np.where(arm.slides, 2.0, SOFT)


def _fourier(arm: Arm, period: float, rng: np.random.Generator) -> FourierPath:
    low, high, top, soft = _limits(arm)
    pace = 2.0 * np.pi / period
    count = max(5, round(period * 0.45))
    probe = np.linspace(0.0, period, 400)
    path = FourierPath(0.5 * (low + high), np.zeros((arm.n, 1)), np.zeros((arm.n, 1)), pace)
    for _ in range(40):
        fall = 1.0 / np.sqrt(np.arange(1, count + 1))
        sines, cosines = rng.normal(size=(2, arm.n, count)) * fall
        q, qd, qdd = FourierPath(np.zeros(arm.n), sines, cosines, pace)(probe)
        room = 0.5 * (high - low) * rng.uniform(0.5, 0.95, arm.n)
        factor = np.minimum(room / (0.5 * np.ptp(q, axis=0)), top / np.abs(qd).max(axis=0))
        factor = np.minimum(factor, soft / np.abs(qdd).max(axis=0))
        sines, cosines = sines * factor[:, None], cosines * factor[:, None]
        half = 0.5 * factor * np.ptp(q, axis=0)
        centre = factor * 0.5 * (q.max(axis=0) + q.min(axis=0))
        middle = rng.uniform(low + half, np.maximum(high - half, low + half)) - centre
        path = FourierPath(middle, sines, cosines, pace)
        if _above_floor(arm, path(probe)[0]):
            break
    return path


def _stops(
    arm: Arm, seconds: float, rng: np.random.Generator, peak: float = SOFT, far: float = FAR
) -> StopPath:
    low, high, top, soft = _limits(arm)
    soft = soft * peak / SOFT
    stops, leave, last, now = [rng.uniform(low, high)], [], [], 0.0
    while now < seconds:
        goal = _next_stop(stops[-1], low, high, rng, far)
        for _ in range(40):
            if _above_floor(arm, goal[None]):
                break
            goal = _next_stop(stops[-1], low, high, rng, far)
        way = np.abs(goal - stops[-1])
        # peaks of a fifth-order move: 1.875 of the mean speed, 5.774 of way over time squared
        need = max(float((1.875 * way / top).max()), float(np.sqrt(5.774 * way / soft).max()), 0.3)
        now += rng.uniform(0.1, 0.6)
        stops.append(goal)
        leave.append(now)
        last.append(need * rng.uniform(1.0, 1.6))
        now += last[-1]
    return StopPath(np.array(stops), np.array(leave), np.array(last))


def _next_stop(
    stop: np.ndarray, low: np.ndarray, high: np.ndarray, rng: np.random.Generator, far: float
) -> np.ndarray:
    """A stop up to a share `far` of each joint's range away."""
    return np.clip(stop + rng.uniform(-far, far, len(stop)) * (high - low), low, high)


def _above_floor(arm: Arm, q: np.ndarray) -> bool:
    return bool(stance(arm, q).flange_places[:, 2].min() > FLOOR)
