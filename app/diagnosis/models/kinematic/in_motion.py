"""A recording taken while the arm moves: how fast its joints go, and where they were some time before a stamp."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import Akima1DInterpolator

from app.diagnosis.thresholds.conventions import AT_ONCE, BURSTS, IN_MOTION


def moves_on(time: np.ndarray, sessions: np.ndarray) -> bool:
    """True where rows follow each other so closely that the arm cannot have stopped for each.

    Args:
        time: (m,) [s]; sessions (m,) number of the session.
    """
    steps = np.diff(time)[np.diff(sessions) == 0]
    return len(steps) > 0 and bool(np.all(steps >= 0)) and 0.0 < float(np.mean(steps)) < IN_MOTION


def speeds(time: np.ndarray, q: np.ndarray, sessions: np.ndarray) -> np.ndarray:
    """(m, n) speed of each joint [rad/s or m/s] in a recording made in motion; zeros in any other.

    Args:
        time: (m,) [s]; rows stamped at once share a speed.
        q: (m, n) [rad or m].
        sessions: (m,) number of the session; none goes over into the next.
    """
    out = np.zeros(q.shape)
    if not moves_on(time, sessions):
        return out
    for session in np.unique(sessions):
        own = sessions == session
        at, mean = _moments(time[own], q[own])
        if len(at) > 1:
            slope = np.gradient(mean, at, axis=0)
            out[own] = np.stack([np.interp(time[own], at, column) for column in slope.T], axis=1)
    return out


def joints_at(time: np.ndarray, q: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """(m, n) joints at the wanted times (m,) [s], by a smooth curve through those recorded; beyond the ends the arm
    rests. Akima's curve does not swing where the times are uneven."""
    at, mean = _moments(time, q)
    return Akima1DInterpolator(at, mean)(np.clip(wanted, at[0], at[-1]))


def evenly(time: np.ndarray) -> np.ndarray:
    """(m,) times [s] of rows that were measured at an even rate and stamped as they arrived."""
    rows = np.arange(len(time))
    slope, start = np.polyfit(rows, time, 1)
    return start + slope * rows


def in_bursts(time: np.ndarray) -> bool:
    """True where many rows are stamped with one moment, and then none for a while: a network's buffer, no clock."""
    steps = np.diff(time)
    return bool(np.mean(steps < AT_ONCE * np.mean(steps)) > BURSTS)


def _moments(time: np.ndarray, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(k,) moments [s] and the joints (k, n) there: rows apart by less than a part of the usual step share one."""
    steps = np.diff(time)
    index = np.concatenate([[0], np.cumsum(steps > AT_ONCE * np.mean(steps))])
    count = np.bincount(index)
    mean = np.stack([np.bincount(index, column) / count for column in q.T], axis=1)
    return np.bincount(index, time) / count, mean
