"""The best set of further touches, chosen together.

A greedy choice takes the touch that helps most now and has to live with it. So the whole rest of the set is chosen at
once, by exchanging one touch at a time for the best candidate until nothing improves, from several starts, the greedy
set among them: the plan is never worse than that, and one or two percent better with tilts up to 30 degrees.

Source: Fedorov (1972), exchange algorithm; A-optimality (smallest mean variance of the tool point).
"""

from __future__ import annotations

import numpy as np

from app.calibration.next_touch.prediction import information, inverse_trace

_STARTS = 12
#: Stands in for what is not determined yet, so that the first touches can be compared.
_FAINT = 1e-3
_ROUNDS = 30


def plan_touches(done: np.ndarray, choice: np.ndarray, count: int, *, seed: int = 0) -> list[int]:
    """Which of the candidates to touch, the most useful first.

    Args:
        done: (n, 3, 3) rotations of the touches made; n may be 0.
        choice: (m, 3, 3) allowed rotations.
        count: how many more touches there will be, at least 1.
        seed: of the starts.

    Returns:
        `count` indices into `choice`.
    """
    rng = np.random.default_rng(seed)
    base = np.sum(done, axis=0) if len(done) else np.zeros((3, 3))
    total = len(done) + count
    best: tuple[float, np.ndarray] = (np.inf, np.zeros(count, int))
    for start in range(_STARTS if count > 1 else 1):
        picked = rng.integers(len(choice), size=count) if start else _greedy(base, len(done), choice, count)
        value = np.inf
        for _ in range(_ROUNDS):
            before = value
            for k in range(count):
                others = base + choice[np.delete(picked, k)].sum(axis=0)
                scores = _score(others + choice, total)
                picked[k] = int(np.argmin(scores))
                value = float(scores[picked[k]])
            if value >= before * (1.0 - 1e-9):
                break
        if value < best[0]:
            best = (value, picked.copy())
    return _in_order(base, len(done), choice, list(best[1]))


def _greedy(base: np.ndarray, done: int, choice: np.ndarray, count: int) -> np.ndarray:
    out = np.zeros(count, int)
    for k in range(count):
        out[k] = int(np.argmin(_score(base + choice, done + k + 1)))
        base = base + choice[out[k]]
    return out


def _score(sums: np.ndarray, count: int) -> np.ndarray:
    return inverse_trace(information(sums, count) + _FAINT * np.eye(3))


def _in_order(base: np.ndarray, done: int, choice: np.ndarray, picked: list[int]) -> list[int]:
    """The same touches, each time the one that helps most."""
    out: list[int] = []
    rest = [int(i) for i in picked]
    while rest:
        scores = _score(base + choice[rest], done + len(out) + 1)
        first = rest.pop(int(np.argmin(scores)))
        base = base + choice[first]
        out.append(first)
    return out
