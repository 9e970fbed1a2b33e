"""In which order poses are visited, and how some of them are come to again."""

from __future__ import annotations

import numpy as np

ASIDE = 0.05  # rad or m: from how far on either side a repeated pose is come to


def visited(
    q: np.ndarray, repeats: int, session: np.ndarray, rng: np.random.Generator, *, either_side: bool
) -> tuple[np.ndarray, np.ndarray]:
    """Poses of which some are come to a second time, later.

    Args:
        q: (m, n) free poses, one a row.
        repeats: how many poses are come to twice; fewer where there are not enough rows.
        session: (m,) set-ups; a pose is repeated within its own.
        either_side: the row before goes to a point aside of the pose, the second time on the other side
            (else: the row before is whatever came before).

    Returns:
        (m, n) poses, and (m,) the number of the pose each row holds.
    """
    q, pose = q.copy(), np.arange(1, len(q) + 1)
    step = 2 if either_side else 1
    for one in np.unique(session):
        rows = np.flatnonzero(session == one)
        half = len(rows) // 2
        count = min(repeats, half // step - 1)
        if count < 1:
            continue
        # the last row of each pair holds the pose; with `either_side` the row before it goes aside first
        first = rows[1 + step * rng.choice(half // step - 1, count, replace=False) + (step - 1)]
        second = rows[half + step * rng.choice(half // step - 1, count, replace=False) + step]
        q[second], pose[second] = q[first], pose[first]
        if either_side:
            aside = (
                ASIDE * rng.uniform(0.3, 1.0, (count, q.shape[1])) * rng.choice([-1, 1], (count, q.shape[1]))
            )
            q[first - 1], q[second - 1] = q[first] - aside, q[first] + aside
    return q, pose
