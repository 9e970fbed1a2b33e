"""Which way an axis points: a circle leaves it open, the direction of turning settles it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

#: Share of the steps that must agree before the order of rows counts as a direction.
_AGREEMENT = 2.0 / 3.0
#: Length of the mean residual vector (1 = all alike) below which angles do not describe the motion at all.
_FOLLOWS = 0.95


@dataclass(frozen=True, eq=False)
class Sense:
    """How points turn about an axis.

    Args:
        sign: +1 where the turn is right-handed about the fit's direction, -1 where it is left-handed, 0 where
            it cannot be told.
        odd: (n,) True for rows that go against the others, or whose angle does not fit its place.
        gap: (n,) [rad] place on the circle minus the angle that was written; None without angles.
        phase: [rad] azimuth of angle zero of every group; None without angles.
        travel: [rad] from the first to the last place of the widest circle, at most a full turn.
    """

    sign: int
    odd: np.ndarray
    gap: np.ndarray | None = None
    phase: np.ndarray | None = None
    travel: float = 0.0


def wrapped(angle: np.ndarray) -> np.ndarray:
    """Into (-pi, pi]."""
    return -np.remainder(np.pi - angle, 2.0 * np.pi) + np.pi


def sense_from_angles(
    azimuths: np.ndarray, angles: np.ndarray, groups: np.ndarray, weights: np.ndarray, tolerance: float
) -> Sense:
    """The sign for which `azimuth - sign * angle` is the same for every row of a group.

    Args:
        azimuths, angles: (n,) [rad].
        groups: (n,) circle each point belongs to; circles have their own phase.
        weights: (n,) how much a row counts: its radius, so that points near the axis do not vote.
        tolerance: [rad] largest gap that is no mistake.
    """
    best: tuple[float, int, np.ndarray, np.ndarray] | None = None
    for sign in (1, -1):
        turned = np.exp(1j * (azimuths - sign * angles))
        sums = np.array([np.sum((weights * turned)[groups == g]) for g in range(groups.max() + 1)])
        length = float(np.abs(sums).sum() / weights.sum())
        phase = np.angle(sums)
        if best is None or length > best[0]:
            best = (length, sign, phase, wrapped(azimuths - sign * angles - phase[groups]))
    assert best is not None
    length, sign, phase, gap = best
    middle = np.median(gap)
    odd = np.abs(wrapped(gap - middle)) > tolerance
    travel = _travel(sign * angles + gap, groups, weights)
    return Sense(sign if length > _FOLLOWS else 0, odd, gap, phase, travel)


def _travel(place: np.ndarray, groups: np.ndarray, weights: np.ndarray) -> float:
    widest = groups[int(np.argmax(weights))]
    return float(min(np.ptp(place[groups == widest]), 2.0 * np.pi))


def sense_from_order(azimuths: np.ndarray, groups: np.ndarray, weights: np.ndarray) -> Sense:
    """The sign of the steps from row to row; rows that step the other way are odd.

    Args:
        azimuths: (n,) [rad] in the order of rows.
        groups, weights: as above.
    """
    forward = backward = 0
    steps_of: list[tuple[np.ndarray, np.ndarray]] = []
    for g in range(groups.max() + 1):
        mine = np.flatnonzero(groups == g)
        steps = wrapped(np.diff(azimuths[mine]))
        forward, backward = forward + int((steps > 0).sum()), backward + int((steps < 0).sum())
        steps_of.append((mine, steps))
    total = forward + backward
    sign = 1 if forward >= backward else -1
    odd = np.zeros(len(azimuths), bool)
    for mine, steps in steps_of:
        odd[mine[1:]] = sign * steps <= 0
    agree = max(forward, backward)
    place = np.zeros(len(azimuths))
    for mine, steps in steps_of:
        place[mine[1:]] = np.cumsum(steps)
    travel = _travel(place, groups, weights)
    return Sense(sign if total and agree >= _AGREEMENT * total else 0, odd, travel=travel)
