"""How sharply dry friction turns over at rest: joint by joint, where a log tells it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.models.dynamic.library import laws
from app.diagnosis.thresholds.friction import STRIBECK, SURE, TOGETHER, WIDER
from app.kinematics.dynamics import PER_LINK

if TYPE_CHECKING:
    from app.diagnosis.models.dynamic.samples import Samples


def learnt_widths(samples: Samples) -> np.ndarray:
    """(n,) speed [rad/s] at which dry friction has reached 76% of its level."""
    state = samples.state
    y = samples.y - samples.description
    out = state.width.copy()
    rows, still = len(y), [law for law in laws().values() if law.standstill]
    for j in range(state.joints):
        if not state.moves(j):
            continue
        qd = state.qd[:, j]
        own = [np.ones(rows), qd, qd * np.abs(qd), state.qdd[:, j]]
        rests = [
            law.columns(state, place)[j][:, 0]
            for law in still
            for place in law.places(state)
            if place.where["joint"] == j + 1
        ]
        fixed = np.hstack([state.regressor[:, j, PER_LINK * j :], np.stack([*own, *rests], axis=1)])
        size = np.sqrt(np.mean(fixed**2, axis=0))
        fixed = fixed[:, size > 1e-12] / size[size > 1e-12]
        best = (-np.inf, out[j])
        for k, wider in enumerate(WIDER):
            width = out[j] * wider
            if wider > 1.0 and width > 0.3 * state.speed[j]:
                break
            turn = state.direction(j, width)
            fading = [turn * np.exp(-((qd / (share * state.speed[j])) ** 2)) for share in STRIBECK]
            columns = np.column_stack([fixed, turn, *fading])
            left = _left(columns, y[:, j], len(fading))
            score = -rows / TOGETHER / 2.0 * float(np.log(np.mean(left**2) + 1e-300)) - (SURE if k else 0.0)
            if score > best[0]:
                best = (score, width)
        out[j] = best[1]
    return out


def _left(columns: np.ndarray, y: np.ndarray, fading: int) -> np.ndarray:
    """(M,) what a fit leaves; last columns against the dry friction before them are no Stribeck friction."""
    gram, right = columns.T @ columns, columns.T @ y
    gram[np.diag_indices_from(gram)] += 1e-6 * len(y)
    kept = np.arange(columns.shape[1])
    weights = np.zeros(0)
    for _ in range(fading + 1):
        weights = np.linalg.solve(gram[np.ix_(kept, kept)], right[kept])
        first = columns.shape[1] - fading
        dry = float(weights[first - 1])
        against = [k for k, w in zip(kept, weights, strict=True) if k >= first and w * dry < 0]
        if not against:
            break
        kept = kept[~np.isin(kept, against)]
    return y - columns[:, kept] @ weights
