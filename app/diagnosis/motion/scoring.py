"""One model against all candidates: scores, their null under sign flips by block, and what is visible.

Source: score test with nuisance projected off (Rao 1948); sign flips of a residual (Winkler et al. 2014).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import gammaincc, gammaln

from app.diagnosis.motion.system import Group, System

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
    blocks: np.ndarray | None = None,
) -> Solution:
    """Least squares with the prior's information (60, 60) on the inertial part.

    Args:
        prior: (i, i) information matrix of the leading unknowns.
    """
    A, g, yy = system.normal(selected, blocks)
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
        rows: (r, B + 1) whitened block scores of all candidates one under the other; `starts` (c,) says where.
    """

    candidates: list[Candidate]
    gain: np.ndarray
    score: np.ndarray
    sizes: np.ndarray
    rows: np.ndarray
    starts: np.ndarray


def score_all(
    system: System,
    solution: Solution,
    groups: list[Group],
    windows: dict[Group, np.ndarray],
    bases: list[Group],
) -> Board:
    """Scores every group, and every window (w, 2) of block edges of every base group."""
    inverse, theta = solution.covariance, solution.theta
    blocks, p = system.block_count, len(theta)
    scores = system.block_scores(theta, solution.columns, solution.positions)  # per joint (B, P)
    score_nuisance = np.zeros((p, blocks))
    for u, col, pos in zip(scores, solution.columns, solution.positions, strict=True):
        score_nuisance[pos] += u[:, col].T
    # The prior's own observations are one more block: with it the scores of the nuisance add up to zero.
    score_nuisance = np.column_stack([score_nuisance, -score_nuisance.sum(1)])
    scores = [np.concatenate([u, np.zeros_like(u[:1])]) for u in scores]
    blocks += 1
    spread = inverse @ score_nuisance  # (p, B)
    found: list[Batch] = []
    local: dict[tuple[int, int], list[Group]] = {}
    for group in groups:
        if group.joint is not None:
            local.setdefault((group.joint, group.size), []).append(group)
            continue
        raw, cross, block = _shared(system, solution, scores, group)
        matrix = raw - cross @ inverse @ cross.T
        found.append(Batch([group], raw[None], matrix[None], (block - cross @ spread)[None], None))
    for (j, size), members in local.items():
        part, col, pos = system.parts[j], solution.columns[j], solution.positions[j]
        at = np.array([np.arange(part.places[g].start, part.places[g].stop) for g in members])  # (g, k)
        cross = part.total[at[:, :, None], col]  # (g, k, p)
        raw = part.total[at[:, :, None], at[:, None, :]]
        flat = cross.reshape(-1, len(col))
        half = (flat @ inverse[np.ix_(pos, pos)]).reshape(cross.shape)
        matrix = raw - half @ np.swapaxes(cross, 1, 2)
        block = np.moveaxis(scores[j][:, at], 0, -1) - (flat @ spread[pos]).reshape(
            len(members), size, blocks
        )
        found.append(Batch(members, raw, matrix, block, None))
    found += [_windows(system, solution, scores, spread, group, windows[group]) for group in bases]
    return _board(found, blocks)


@dataclass(frozen=True, eq=False)
class Batch:
    """Groups of one size: Gram matrices bare and projected (c, k, k), projected block scores (c, k, B)."""

    groups: list[Group]
    raw: np.ndarray
    matrix: np.ndarray
    block: np.ndarray
    windows: np.ndarray | None


def _board(batches: list[Batch], blocks: int) -> Board:
    """Keeps what this log can see; rows are scaled so that squares of their sums add up to the gain."""
    candidates: list[Candidate] = []
    rows, starts, at = [], [], 0
    for batch in batches:
        diagonal = np.diagonal(batch.raw, axis1=1, axis2=2)
        scale = np.sqrt(np.where(diagonal > 0, diagonal, 1.0))
        scaled = batch.matrix / scale[:, :, None] / scale[:, None, :]
        size = batch.raw.shape[1]
        if size == 1:
            values, vectors = scaled[:, :, 0], np.ones_like(scaled)
        else:
            values, vectors = np.linalg.eigh(scaled)
        least = LEAST_VISIBLE_SHARED if batch.groups[0].joint is None else LEAST_VISIBLE
        keep = (values > least**2) & np.all(diagonal > 0, axis=1)[:, None]
        half = np.swapaxes(vectors, 1, 2) / np.sqrt(np.where(keep, values, np.inf))[:, :, None]
        done = half @ (batch.block / scale[:, :, None])
        visible = np.sqrt(np.clip(values.mean(1), 0.0, 1.0))
        count = keep.sum(1)
        for c in np.flatnonzero(count):
            group = batch.groups[c] if batch.windows is None else batch.groups[0]
            window = None if batch.windows is None else (int(batch.windows[c, 0]), int(batch.windows[c, 1]))
            candidates.append(Candidate(group, int(count[c]), float(visible[c]), window))
            starts.append(at)
            at += size
        rows.append(done[count > 0].reshape(-1, blocks))
    if not candidates:
        empty = np.zeros(0)
        return Board([], empty, empty, empty, np.zeros((0, blocks)), empty.astype(int))
    sizes, begin, stacked = np.array([c.size for c in candidates]), np.array(starts), np.concatenate(rows)
    gain = np.add.reduceat(stacked.sum(1) ** 2, begin)
    return Board(candidates, gain, minus_log_p(gain, sizes), sizes, stacked, begin)


def _windows(system, solution, scores, spread, group: Group, windows: np.ndarray) -> Batch:
    """All windows of one base group at once: sums over blocks are differences of running sums."""
    D, E, U = _per_block(system, solution, scores, group)
    D = np.concatenate([np.zeros_like(D[:1]), np.cumsum(D, 0)])
    E = np.concatenate([np.zeros_like(E[:1]), np.cumsum(E, 0)])
    a, b = windows[:, 0], windows[:, 1]
    raw, cross = D[b] - D[a], E[b] - E[a]  # (w, k, k), (w, k, p)
    flat = cross.reshape(-1, cross.shape[2])
    matrix = raw - (flat @ solution.covariance).reshape(cross.shape) @ np.swapaxes(cross, 1, 2)
    index = np.arange(len(U))
    inside = (index >= a[:, None]) & (index < b[:, None])  # (w, B)
    block = inside[:, None, :] * U.T[None] - (flat @ spread).reshape(len(a), group.size, -1)
    return Batch([group], raw, matrix, block, windows)


def _shared(system: System, solution: Solution, scores: list[np.ndarray], group: Group):
    p = len(solution.theta)
    raw, cross = np.zeros((group.size, group.size)), np.zeros((group.size, p))
    block = np.zeros((group.size, len(scores[0])))
    for part, col, pos, u in zip(system.parts, solution.columns, solution.positions, scores, strict=True):
        place = part.places[group]
        raw += part.total[place, place]
        cross[:, pos] += part.total[place][:, col]
        block += u[:, place].T
    return raw, cross, block


def _per_block(system: System, solution: Solution, scores: list[np.ndarray], group: Group):
    blocks, p, k = system.block_count, len(solution.theta), group.size
    D, E, U = np.zeros((blocks, k, k)), np.zeros((blocks, k, p)), np.zeros((len(scores[0]), k))
    for j, (part, col, pos) in enumerate(
        zip(system.parts, solution.columns, solution.positions, strict=True)
    ):
        if group.joint is not None and group.joint != j:
            continue
        place = part.places[group]
        own = part.activate(np.arange(place.start, place.stop), system.edges)
        rest = part.activate(col, system.edges)
        D += part.blocks[:, own[:, None], own]
        E[:, :, pos] += part.blocks[:, own[:, None], rest]
        U += scores[j][:, place]
    return D, E, U


def minus_log_p(gain: np.ndarray, size: np.ndarray) -> np.ndarray:
    """-log10 of the chi-squared tail; its leading term where the tail is too small for a number."""
    gain, half = np.maximum(gain, 1e-12), np.asarray(size) / 2.0
    far = gain / 2.0 - (half - 1.0) * np.log(gain / 2.0) + gammaln(half)
    near = -np.log(np.maximum(gammaincc(half, gain / 2.0), 1e-290))
    return np.where(gain > 600.0 + size, far, near) / np.log(10.0)


def null_scores(board: Board, signs: np.ndarray) -> np.ndarray:
    """(K,) the largest score over the whole board under sign flips by block; signs (K, B)."""
    sums = board.rows @ signs.T  # (r, K)
    gain = np.add.reduceat(sums**2, board.starts, axis=0)  # (c, K)
    best = np.full(signs.shape[0], -np.inf)
    for size in np.unique(board.sizes):
        top = gain[board.sizes == size].max(axis=0)
        best = np.maximum(best, minus_log_p(top, np.full_like(top, size)))
    return best
