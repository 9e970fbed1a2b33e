"""Several logs of one arm as one: one after the other on one clock, each smoothed by itself, with a gap between.

What the arm is, is then asked of all samples at once; what changes from log to log (friction that falls as the gears
warm up, a load that was taken up between) is asked as it is within one log: along the common time.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from app.diagnosis.models.dynamic.smoothing import Motion
from app.diagnosis.observations.joint_log import Log
from app.diagnosis.thresholds.rows import GAP

Ready = tuple[Log, Motion, frozenset[str]]


def in_order(logs: Sequence[Ready]) -> list[int]:
    """Places of the logs in time: by their clocks where no two overlap, else as they were given."""
    order = sorted(range(len(logs)), key=lambda k: float(logs[k][0].t[0]))
    apart = all(logs[a][0].t[-1] < logs[b][0].t[0] for a, b in pairwise(order))
    return order if apart else list(range(len(logs)))


def joined(logs: Sequence[Ready]) -> Ready:
    """One log of several that stand in the order of time.

    A pause counts for no longer than the longest log lasts: what happened in it was not recorded.
    """
    only, motions = [log for log, _, _ in logs], [motion for _, motion, _ in logs]
    longest = max(float(log.t[-1] - log.t[0]) for log in only)
    times, ends = [only[0].t - only[0].t[0]], [only[0].t[-1]]
    for log in only[1:]:
        least = 2.0 * GAP * log.step
        pause = float(log.t[0] - ends[-1])
        start = times[-1][-1] + (min(pause, longest) if pause > least else least)
        times.append(log.t - log.t[0] + start)
        ends.append(log.t[-1])
    starts = np.cumsum([0, *(len(log.t) for log in only[:-1])])
    segments = [
        slice(s.start + int(k), s.stop + int(k))
        for log, k in zip(only, starts, strict=True)
        for s in log.segments
    ]
    notes = tuple(dict.fromkeys(note for log in only for note in log.notes))
    spiked = np.concatenate([log.spiked if log.spiked.size else np.zeros(log.y.shape, bool) for log in only])
    log = replace(
        only[0], t=np.concatenate(times), q=np.concatenate([log.q for log in only]),
        qd=_all([log.qd for log in only]), y=np.concatenate([log.y for log in only]),
        temperature=_all([log.temperature for log in only]), commanded=_all([log.commanded for log in only]),
        motor=_all([log.motor for log in only]),
        rows=np.concatenate([log.rows for log in only]), segments=segments,
        step=float(np.median([log.step for log in only])), total=sum(log.total for log in only),
        dropped=np.concatenate([log.dropped for log in only]), notes=notes, spiked=spiked,
        stated_noise=only[0].stated_noise if all(log.stated_noise is not None for log in only) else None,
    )  # fmt: skip
    motion = replace(
        motions[0], q=np.concatenate([m.q for m in motions]), qd=np.concatenate([m.qd for m in motions]),
        qdd=np.concatenate([m.qdd for m in motions]), speed_noise=np.max([m.speed_noise for m in motions], axis=0),
    )  # fmt: skip
    return log, motion, frozenset().union(*(without for _, _, without in logs))


def _all(values: Sequence[np.ndarray | None]) -> np.ndarray | None:
    """Columns of all logs one after the other; None where one of them has none."""
    there = [v for v in values if v is not None]
    return np.concatenate(there) if len(there) == len(values) else None
