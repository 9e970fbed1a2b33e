"""Two terms exchanged for two others at once: what swaps of one term alone cannot reach.

Two wrong terms can hold each other up: each is the best there is beside the other. All pairs of candidates are
therefore compared, through inner products of their orthonormal columns alone. With `b` the products with the
residual, `G` those of two candidates and `S = I - G_ba G_ab` what `a` leaves of `b`, the pair takes
`|b_a|^2 + (b_b - G_ba b_a)^T S^-1 (b_b - G_ba b_a)` off the sum of squares.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.diagnosis.static.fit import Fitted
from app.diagnosis.static.library import Candidate, Library, library
from app.diagnosis.static.looking import LEAST_VISIBLE, score_all, without
from app.diagnosis.static.score import Basis, Scores, basis, orthonormal

#: Share of a candidate that its companion must leave for the two to be told apart.
_APART = 0.02
#: Steps are looked at in their best row only, and only so many of them.
_STEPS = 12


@dataclass(frozen=True)
class Pair:
    """Two candidates together.

    Args:
        delta: BIC of the model with them instead of the terms taken out, minus that of the present one.
    """

    first: Candidate
    second: Candidate
    delta: float


def rival_pairs(
    fitted: Fitted, indices: tuple[int, int], wanted: tuple[Candidate, ...], most: int = 8
) -> list[Pair]:
    """The best pairs in place of the two terms, by the linear model; best first.

    Args:
        indices: of the terms that make way.
    """
    jacobian, white = without(fitted, *indices)
    base = basis(jacobian)
    rest = white - base.q @ (base.q.T @ white)
    lib = library(fitted.columns, wanted, fitted.ghosts)
    scores = score_all(fitted, lib, base, None, white)
    named, blocks = _columns(fitted, lib, scores, base)
    rss, n = float(rest @ rest), fitted.size
    size = np.array([block.shape[1] for block in blocks])
    starts = np.concatenate([[0], np.cumsum(size)]).astype(int)
    unit = np.concatenate(blocks, axis=1) if blocks else np.zeros((len(rest), 0))
    gram, right = unit.T @ unit, unit.T @ rest
    taken = sum(len(fitted.terms[i].values) for i in indices)
    mine = n * np.log(fitted.rss / n) + taken * np.log(n)
    gains = _together(gram, right, starts, size)
    delta = n * np.log(np.maximum(rss - gains, 1e-300) / n) + (size[:, None] + size) * np.log(n) - mine
    delta[~np.isfinite(gains)] = np.inf
    best = np.argsort(delta, axis=None)[:most]
    pairs = [(int(at) // len(size), int(at) % len(size)) for at in best]
    return [Pair(named[a], named[b], float(delta[a, b])) for a, b in pairs if np.isfinite(delta[a, b])]


def _together(gram: np.ndarray, right: np.ndarray, starts: np.ndarray, size: np.ndarray) -> np.ndarray:
    """(g, g) what two candidates take off together, above the diagonal; minus infinity for those that are one."""
    count = len(size)
    out = np.full((count, count), -np.inf)
    one = np.flatnonzero(size == 1)
    at = starts[:-1][one]
    cross, own = gram[np.ix_(at, at)], right[at]
    share = 1.0 - cross**2
    seen = share > _APART
    second = (own[None, :] - cross * own[:, None]) ** 2 / np.where(seen, share, 1.0)
    out[np.ix_(one, one)] = np.where(seen, own[:, None] ** 2 + second, -np.inf)
    # Those of several columns are filled up with columns of nothing, so that all are of one size.
    wide = int(size.max(initial=1))
    index = np.full((count, wide), gram.shape[0])
    for g in range(count):
        index[g, : size[g]] = np.arange(starts[g], starts[g + 1])
    padded = np.zeros((gram.shape[0] + 1,) * 2)
    padded[:-1, :-1] = gram
    values = np.append(right, 0.0)[index]  # (g, wide)
    for a in np.flatnonzero(size > 1):
        cross = padded[index[:, :, None], index[a]]  # (g, wide, wide)
        left = values - cross @ values[a]
        kept = np.eye(wide) - cross @ np.swapaxes(cross, 1, 2)
        shares, axes = np.linalg.eigh(kept)
        good = (shares > _APART) & (np.abs(left).max(axis=1, keepdims=True) > 0)
        more = np.einsum("gij,gi->gj", axes, left) ** 2 / np.where(good, shares, 1.0)
        gain = float(values[a] @ values[a]) + np.sum(np.where(good, more, 0.0), axis=1)
        apart = (shares > _APART).sum(axis=1) > wide - size  # what was filled up does not count
        out[a] = np.where(apart, gain, -np.inf)
        out[:, a] = out[a]
    out[np.tril_indices(count)] = -np.inf  # every pair once
    return out


def _columns(fitted: Fitted, lib: Library, scores: Scores, base: Basis):
    """Every candidate that can be seen, with its orthonormal columns; steps at their best row."""
    raw = np.einsum("ng,ng->g", lib.matrix, lib.matrix)
    sizes = np.diff(lib.starts)
    unit, visible = orthonormal(base.project(lib.matrix), raw, lib.starts, sizes)
    named, blocks = [], []
    for index, candidate in enumerate(lib.candidates):
        block = unit[:, lib.starts[index] : lib.starts[index + 1]]
        block = block[:, np.any(block != 0.0, axis=0)]
        if visible[index] >= LEAST_VISIBLE and block.shape[1]:
            named.append(candidate)
            blocks.append(block)
    steps = [at for at in scores.order() if at >= len(lib.candidates)]
    for at in steps[:_STEPS]:
        candidate = scores.candidates[at]
        if scores.visible[at] < LEAST_VISIBLE:
            continue
        columns = candidate.effect.columns(fitted.columns, candidate.place)
        columns = columns.reshape(-1, columns.shape[2])
        padding = np.zeros((len(base.q) - len(columns), columns.shape[1]))
        named.append(candidate)
        blocks.append(basis(base.project(np.concatenate([columns, padding]))).q)
    return named, blocks
