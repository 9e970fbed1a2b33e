"""One model against all candidates: scores, their null under sign flips by block, and what is visible.

Source: score test with nuisance projected off (Rao 1948); sign flips of a residual (Winkler et al. 2014).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.special import gammaincc, gammaln

from app.diagnosis.motion.batches import Batch, singles, windows_of
from app.diagnosis.motion.directions import halved
from app.diagnosis.motion.system import REMEMBERED, Group, System

BLIND = 1e-6  # inverse of the standard deviation given to what cannot be seen
LEAST_VISIBLE = 0.05  # of a law on one joint
#: Loads and leaning are held back by the prior of the masses alone: what little of them shows is trusted.
LEAST_VISIBLE_SHARED = 3e-4


@dataclass(frozen=True, eq=False)
class Solution:
    """A model's unknowns.

    Args:
        theta: (p,); inertial first.
        covariance: (p, p) in whitened units.
        rss: whitened, with the prior's share.
    """

    selected: list[Group]
    theta: np.ndarray
    covariance: np.ndarray
    rss: float
    columns: list[np.ndarray]
    positions: list[np.ndarray]


def solve(
    system: System,
    selected: list[Group],
    prior: np.ndarray,
) -> Solution:
    """Least squares with the prior's information (60, 60) on the inertial part.

    Args:
        prior: (i, i) information matrix of the leading unknowns.
    """
    key = tuple(selected)
    known = system.solutions.pop(key, None)
    if known is None or known[0] is not prior:
        known = (prior, _solved(system, selected, prior))
        if len(system.solutions) >= REMEMBERED:
            del system.solutions[next(iter(system.solutions))]
    system.solutions[key] = known  # the one asked for last goes last
    return known[1]


def _solved(system: System, selected: list[Group], prior: np.ndarray) -> Solution:
    A, g, yy = system.normal(selected)
    i = len(prior)
    A[:i, :i] += prior
    scale = np.sqrt(np.diag(A))
    blind = scale <= 1e-9 * scale.max()  # columns this log does not excite: they stay zero and uncertain
    scale[blind] = np.inf
    A = A / scale / scale[:, None]
    A[np.diag_indices_from(A)] += np.where(blind, 1.0, 1e-11)
    scale[blind] = BLIND
    inverse = np.linalg.inv(A) / scale / scale[:, None]
    inverse = 0.5 * (inverse + inverse.T)
    theta = inverse @ np.where(blind, 0.0, g)
    columns, positions, _ = system.layout(selected)
    return Solution(selected, theta, inverse, yy - float(g @ theta), columns, positions)


@dataclass(frozen=True, eq=False)
class Candidate:
    """Something that could be added: a group, or a window cut from one."""

    group: Group
    size: int
    visible: float
    window: tuple[int, int] | None = None


@dataclass(frozen=True, eq=False)
class Board:
    """Scores of all candidates against one model.

    Args:
        gain: (c,) fall of the whitened sum of squares if it is added.
        score: (c,) -log10 p.
        sizes, visible: (c,).
        rows: per batch (c, k, B + 1), scaled so that squares of their sums add up to the gain.
        batches: where the candidates come from; `batch`, `item` (c,) say which each is.
    """

    gain: np.ndarray
    score: np.ndarray
    sizes: np.ndarray
    visible: np.ndarray
    rows: list[np.ndarray]
    batches: list[Batch]
    batch: np.ndarray
    item: np.ndarray

    def __len__(self) -> int:
        return len(self.gain)

    def all(self) -> Iterator[Candidate]:
        return (self[k] for k in range(len(self)))

    def __getitem__(self, index: int) -> Candidate:
        batch, c = self.batches[self.batch[index]], int(self.item[index])
        group, window = batch.groups[c if batch.windows is None else 0], None
        if batch.windows is not None:
            window = (int(batch.windows[c, 0]), int(batch.windows[c, 1]))
        return Candidate(group, int(self.sizes[index]), float(self.visible[index]), window)


def score_all(
    system: System,
    solution: Solution,
    groups: list[Group],
    windows: dict[Group, np.ndarray],
    bases: list[Group],
    *,
    null: bool = True,
) -> Board:
    """Scores every group, and every window (w, 2) of block edges of every base group.

    Args:
        null: False where no null will be drawn: scores are then not kept block by block.
    """
    inverse, theta = solution.covariance, solution.theta
    p = len(theta)
    if null:
        scores = system.block_scores(theta, solution.columns, solution.positions)  # per joint (B, P)
        nuisance = np.zeros((p, system.block_count))
        for u, col, pos in zip(scores, solution.columns, solution.positions, strict=True):
            nuisance[pos] += u[:, col].T
        # The prior's own observations are one more block: with it the scores of the nuisance add up to zero.
        nuisance = np.column_stack([nuisance, -nuisance.sum(1)])
        scores = [np.concatenate([u, np.zeros_like(u[:1])]) for u in scores]
        spread = inverse @ nuisance  # (p, B + 1)
    else:
        scores = [
            part.scores(col, theta[pos])[None]
            for part, col, pos in zip(system.parts, solution.columns, solution.positions, strict=True)
        ]
        spread = np.zeros((p, 1))
    found = singles(system, solution, scores, spread, groups)
    found += [windows_of(system, solution, spread, group, windows[group], null) for group in bases]
    return _board(found)


def _board(batches: list[Batch]) -> Board:
    """Keeps what this log can see; rows are scaled so that squares of their sums add up to the gain."""
    gains, sizes, visible, rows, items = [], [], [], [], []
    for batch in batches:
        diagonal = np.diagonal(batch.raw, axis1=1, axis2=2)
        scale = np.sqrt(np.where(diagonal > 0, diagonal, 1.0))
        scaled = batch.matrix / scale[:, :, None] / scale[:, None, :]
        least = LEAST_VISIBLE_SHARED if batch.groups[0].joint is None else LEAST_VISIBLE
        done, count = halved(scaled, batch.block / scale[:, :, None], least**2, np.all(diagonal > 0, axis=1))
        seen = np.flatnonzero(count)
        done = done[seen]
        rows.append(done)
        gains.append(np.sum(done.sum(2) ** 2, axis=1))
        sizes.append(count[seen])
        mean = np.trace(scaled[seen], axis1=1, axis2=2) / scaled.shape[1]
        visible.append(np.sqrt(np.clip(mean, 0.0, 1.0)))
        items.append(seen)
    which = np.repeat(np.arange(len(batches)), [len(i) for i in items])
    none = [np.zeros(0)]
    gain, size = np.concatenate(gains or none), np.concatenate(sizes or none).astype(int)
    score = minus_log_p(gain, size)
    item = np.concatenate(items or none).astype(int)
    return Board(gain, score, size, np.concatenate(visible or none), rows, batches, which, item)


def minus_log_p(gain: np.ndarray, size: np.ndarray) -> np.ndarray:
    """-log10 of the chi-squared tail; its leading term where the tail is too small for a number."""
    gain, half = np.maximum(gain, 1e-12), np.asarray(size) / 2.0
    far = gain / 2.0 - (half - 1.0) * np.log(gain / 2.0) + gammaln(half)
    near = -np.log(np.maximum(gammaincc(half, gain / 2.0), 1e-290))
    return np.where(gain > 600.0 + size, far, near) / np.log(10.0)


def null_scores(board: Board, signs: np.ndarray) -> np.ndarray:
    """(K,) the largest score over the whole board under sign flips by block; signs (K, B)."""
    best = np.full(signs.shape[0], -np.inf)
    start = 0
    for rows in board.rows:
        sizes = board.sizes[start : start + len(rows)]
        start += len(rows)
        sums = rows.reshape(-1, rows.shape[2]) @ signs.T  # (c k, K)
        np.square(sums, out=sums)
        gain = sums if rows.shape[1] == 1 else sums.reshape(*rows.shape[:2], len(signs)).sum(1)
        for size in np.unique(sizes):
            top = gain[sizes == size].max(axis=0)
            best = np.maximum(best, minus_log_p(top, np.full_like(top, size)))
    return best
