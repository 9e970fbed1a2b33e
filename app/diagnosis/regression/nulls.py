"""What chance reaches: the gains of all groups when the signs of the residual are drawn at random.

Source: Freedman, Lane, "A nonstochastic interpretation of reported significance levels" (1983): residuals of the
model under the null hypothesis are exchanged, here by flipping the sign of whole blocks.
"""

from __future__ import annotations

import numpy as np

from app.diagnosis.regression.design import Design
from app.diagnosis.regression.evidence import Evidence, Group
from app.diagnosis.thresholds.noise import NULLS

#: Columns whose rows are worked out at once: more of them are hundreds of megabytes in long recordings.
_AT_ONCE = 32


def null_gains(
    evidence: Evidence,
    design: Design,
    residual: np.ndarray,
    block: np.ndarray,
    candidates: list[int],
    seed: int,
) -> np.ndarray:
    """(NULLS,) the largest gain that any candidate group reaches by chance.

    Args:
        design: whose columns the groups are of.
        residual: (N,) whitened, what the model leaves.
        block: (N,) number of the block whose sign is drawn together (a pose, a stretch of time).
    """
    rng = np.random.default_rng(seed)
    signs = rng.choice([-1.0, 1.0], (int(block.max()) + 1, NULLS))
    inside = np.unique(np.concatenate([evidence.groups[g].columns for g in candidates] or [np.zeros(0, int)]))
    right = np.zeros((design.size, NULLS))
    for at in range(0, len(inside), _AT_ONCE):
        part = inside[at : at + _AT_ONCE]
        scores = np.zeros((len(signs), len(part)))
        np.add.at(scores, block, design.explicit(part) * residual[:, None])
        right[part] = scores.T @ signs
    total = float(residual @ residual)
    matrix = evidence.statistics.matrix
    best = np.full(NULLS, -np.inf)
    for size, groups in _by_size([evidence.groups[g] for g in candidates]).items():
        ids = np.array([g.columns for g in groups])
        block_gram = matrix[ids[:, :, None], ids[:, None, :]]
        values, vectors = np.linalg.eigh(block_gram)
        turned = np.einsum("bij,bin->bjn", vectors, right[ids.reshape(-1)].reshape(len(groups), size, NULLS))
        squares = np.moveaxis(turned, 1, 2).reshape(-1, size) ** 2  # (b * NULLS, size)
        each = np.repeat(np.arange(len(groups)), NULLS)
        gain, _ = evidence.best_width(
            np.maximum(values, 0.0)[each], squares, total,
            np.array([g.cap for g in groups])[each], np.array([g.penalty for g in groups])[each],
            groups[0].widths[::2],
        )  # fmt: skip
        best = np.maximum(best, gain.reshape(len(groups), NULLS).max(axis=0))
    return best


def _by_size(groups: list[Group]) -> dict[int, list[Group]]:
    out: dict[int, list[Group]] = {}
    for group in groups:
        out.setdefault(len(group.columns), []).append(group)
    return out


def p_value(gain: float, chance: np.ndarray) -> float:
    """Family-wise: how often chance reaches this gain, one added on either side."""
    return float((1 + np.count_nonzero(chance >= gain)) / (1 + len(chance)))
