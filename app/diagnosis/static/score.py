"""How much of the residual each candidate takes away, and how much chance would have taken.

Everything goes through inner products: the candidates' columns, projected off what is fitted already, are made
orthonormal within each candidate, so that its gain is a sum of squares; all sign-flipped residuals go through
the same matrix product; starting rows are scanned by sums from the end.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import special

from app.diagnosis.static.library import Candidate, Library
from app.diagnosis.static.scan import scan_all, with_row

#: Share of a candidate's column that must survive the projection for it to be scored.
VISIBLE = 0.01
_UNDERFLOW = 1e-280
_NOTHING = np.finfo(float).tiny  # a few touches may leave a flipped residual that is fitted exactly


@dataclass(frozen=True, eq=False)
class Basis:
    """Orthonormal columns of what is fitted already, (N, p)."""

    q: np.ndarray

    def project(self, matrix: np.ndarray) -> np.ndarray:
        return matrix - self.q @ (self.q.T @ matrix)


def basis(jacobian: np.ndarray) -> Basis:
    """Orthonormal basis of the columns; those that depend on earlier ones are dropped."""
    scale = np.sqrt(np.einsum("np,np->p", jacobian, jacobian))
    scaled = jacobian / np.where(scale > 0, scale, 1.0)
    values, vectors = np.linalg.eigh(scaled.T @ scaled)
    keep = values > 1e-9
    first = scaled @ (vectors[:, keep] / np.sqrt(values[keep]))
    # Once more, so that the projection is exact; two small products are quicker than one tall QR.
    lower = np.linalg.cholesky(first.T @ first)
    return Basis(np.linalg.solve(lower, first.T).T)


def significance(gain: np.ndarray, rss: np.ndarray | float, d: int, dof: int) -> np.ndarray:
    """-log10 p of the F test that `d` columns took `gain` off `rss` by chance; dof of the residual before."""
    x = np.clip(1.0 - np.asarray(gain) / np.maximum(rss, _NOTHING), 1e-300, 1.0)
    a, b = 0.5 * max(dof - d, 1), 0.5 * d
    p = special.betainc(a, b, x)
    tail = a * np.log(x) + (b - 1.0) * np.log(np.maximum(1.0 - x, 1e-300)) - np.log(a) - special.betaln(a, b)
    return -np.where(p > _UNDERFLOW, np.log(np.maximum(p, 1e-300)), tail) / np.log(10.0)


@dataclass(frozen=True, eq=False)
class Scores:
    """One entry a candidate, and one a (scan, starting row).

    Args:
        candidates: with `from_row` filled in for scans (their best row).
        score: -log10 p.
        gain: what each takes off the sum of squares.
        visible: share of its signature that survives the projection.
        size: number of its parameters.
        null: (f,) the largest score over everything, for each sign-flipped residual.
    """

    candidates: tuple[Candidate, ...]
    score: np.ndarray
    gain: np.ndarray
    visible: np.ndarray
    size: np.ndarray
    null: np.ndarray

    def order(self) -> np.ndarray:
        return np.argsort(-self.score, kind="stable")

    def p_value(self, index: int) -> float:
        return family_wise(self.score[index], self.null)


def family_wise(score: float, null: np.ndarray) -> float:
    """Share of the null above `score`; beyond its reach by the Gumbel law the maximum of many tests follows."""
    if len(null) == 0:
        return float("nan")
    above = int(np.count_nonzero(null >= score))
    share = (above + 1.0) / (len(null) + 1.0)
    if above >= 3:
        return share
    spread = max(1.0 / np.log(10.0), float(np.std(null)) * np.sqrt(6.0) / np.pi)
    middle = float(np.mean(null)) - np.euler_gamma * spread
    tail = -np.expm1(-np.exp(-(score - middle) / spread))
    return float(min(max(tail, 1e-300), 3.0 / (len(null) + 1.0)))


def flips(rng: np.random.Generator, pose: np.ndarray, count: int) -> np.ndarray:
    """(m, count) of -1 and 1: one sign a pose."""
    signs = rng.integers(0, 2, (int(pose.max()) + 1, count)) * 2.0 - 1.0
    return signs[pose]


def score_library(
    library: Library,
    base: Basis,
    white: np.ndarray,
    rows: int,
    dof: int,
    signs: np.ndarray | None,
    order: np.ndarray,
) -> Scores:
    """Scores of every candidate, and of chance.

    Args:
        white: (N,) residual, already orthogonal to `base`.
        rows: m.
        dof: of the residual.
        signs: (m, f) or None for no null.
        order: (m,) number of each row, for `from_row`.
    """
    per_row = len(white) // rows
    rss = float(white @ white)
    null_count = 0 if signs is None else signs.shape[1]
    flipped = (
        np.zeros((len(white), 0)) if signs is None else white[:, None] * np.repeat(signs, per_row, axis=0)
    )
    overlap = base.q.T @ flipped  # (p, f)
    null_rss = np.full(null_count, rss) - np.einsum("pf,pf->f", overlap, overlap)
    best_null = np.zeros(null_count)

    raw = np.einsum("ng,ng->g", library.matrix, library.matrix)
    projected = base.project(library.matrix)
    sizes = np.diff(library.starts)
    unit, visible = orthonormal(projected, raw, library.starts, sizes)
    both_white = np.column_stack([white, flipped])
    both = unit.T @ both_white  # (g, 1 + f)
    gains = (
        np.add.reduceat(both**2, library.starts[:-1], axis=0) if len(sizes) else np.zeros((0, 1 + null_count))
    )
    score = np.zeros(len(sizes))
    # What physics allows in one direction only takes nothing away in the other.
    against = library.onesided & (both[library.starts[:-1], 0] < 0.0)
    gains[against, 0] = 0.0
    for d in np.unique(sizes):
        mine = sizes == d
        score[mine] = significance(gains[mine, 0], rss, int(d), dof)
        if null_count:
            best_null = np.maximum(
                best_null, significance(gains[mine, 1:].max(axis=0), null_rss, int(d), dof)
            )
    found = list(library.candidates)
    all_gain: list[np.ndarray] = [gains[:, 0]]
    all_score: list[np.ndarray] = [score]
    all_visible: list[np.ndarray] = [visible]
    all_size: list[np.ndarray] = [sizes]
    scans = scan_all([block for _, block in library.scans], base.q, both_white, VISIBLE)
    for (candidate, block), result in zip(library.scans, scans, strict=True):
        if not len(result.rows):
            continue
        d = block.shape[2]
        steps = significance(result.gain[:, 0], rss, d, dof)
        at = int(np.argmax(steps))
        found.append(with_row(candidate, int(order[result.rows[at]])))
        all_gain.append(result.gain[at : at + 1, 0])
        all_score.append(steps[at : at + 1])
        all_visible.append(result.visible[at : at + 1])
        all_size.append(np.array([d]))
        if null_count:
            best_null = np.maximum(best_null, significance(result.gain[:, 1:].max(axis=0), null_rss, d, dof))
    return Scores(
        tuple(found),
        np.concatenate(all_score),
        np.concatenate(all_gain),
        np.concatenate(all_visible),
        np.concatenate(all_size),
        best_null,
    )


def orthonormal(projected: np.ndarray, raw: np.ndarray, starts: np.ndarray, sizes: np.ndarray):
    """Columns made orthonormal within each candidate, and the visible share of each candidate."""
    unit = np.zeros_like(projected)
    visible = np.zeros(len(sizes))
    norms = np.einsum("ng,ng->g", projected, projected)
    single = np.flatnonzero(sizes == 1)
    at = starts[:-1][single]
    visible[single] = np.sqrt(norms[at] / np.maximum(raw[at], 1e-300))
    good = visible[single] > VISIBLE
    unit[:, at[good]] = projected[:, at[good]] / np.sqrt(norms[at[good]])
    for index in np.flatnonzero(sizes > 1):
        span = slice(starts[index], starts[index + 1])
        scale = np.sqrt(np.maximum(raw[span], 1e-300))
        block = projected[:, span] / scale
        values, vectors = np.linalg.eigh(block.T @ block)
        visible[index] = np.sqrt(max(values[-1], 0.0) / sizes[index])
        keep = values > VISIBLE**2
        columns = block @ (vectors[:, keep] / np.sqrt(values[keep]))
        unit[:, starts[index] : starts[index] + columns.shape[1]] = columns
    return unit, visible
