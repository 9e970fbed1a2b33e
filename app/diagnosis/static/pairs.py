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
    products = [block.T @ rest for block in blocks]
    size = np.array([block.shape[1] for block in blocks])
    starts = np.concatenate([[0], np.cumsum(size)]).astype(int)
    unit = np.concatenate(blocks, axis=1) if blocks else np.zeros((len(rest), 0))
    gram, right = unit.T @ unit, unit.T @ rest
    out: list[Pair] = []
    taken = sum(len(fitted.terms[i].values) for i in indices)
    mine = n * np.log(fitted.rss / n) + taken * np.log(n)
    for a, own in enumerate(products):
        span = slice(starts[a], starts[a + 1])
        cross = gram[:, span]  # (g, d)
        left = right - cross @ own
        gains = _second_gains(gram, cross, left, starts, size)
        gains[: a + 1] = -np.inf  # every pair once
        total = np.maximum(rss - float(own @ own) - gains, 1e-300)
        delta = n * np.log(total / n) + (size[a] + size) * np.log(n) - mine
        delta[~np.isfinite(gains)] = np.inf
        best = [b for b in np.argsort(delta)[:most] if np.isfinite(delta[b])]
        out += [Pair(named[a], named[b], float(delta[b])) for b in best]
    return sorted(out, key=lambda pair: pair.delta)[:most]


def _second_gains(
    gram: np.ndarray, cross: np.ndarray, left: np.ndarray, starts: np.ndarray, size: np.ndarray
) -> np.ndarray:
    """What every candidate adds once the first is in; minus infinity where the first leaves too little of it."""
    out = np.full(len(size), -np.inf)
    one = np.flatnonzero(size == 1)
    at = starts[:-1][one]
    share = 1.0 - np.einsum("gd,gd->g", cross[at], cross[at])
    seen = share > _APART
    out[one[seen]] = left[at[seen]] ** 2 / share[seen]
    for index in np.flatnonzero(size > 1):
        span = slice(starts[index], starts[index + 1])
        kept = np.eye(size[index]) - cross[span] @ cross[span].T
        values, vectors = np.linalg.eigh(kept)
        good = values > _APART
        if good.any():
            out[index] = float(np.sum((vectors[:, good].T @ left[span]) ** 2 / values[good]))
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
