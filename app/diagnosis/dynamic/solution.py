"""Values of the selected laws, their uncertainty, and the error on stretches of the log left out.

Two weights. Where nothing is left over, the noise is known and whitened least squares with the posterior's covariance
is right. Where a model is not complete, whitened weights chase what it cannot have: then every sample counts alike,
joint by joint, and the covariance is that of scores summed over stretches of time (block sandwich), which asks nothing
of the residual but that stretches do not hang together.

Source: Newey, West (1987); Cameron, Miller (2015), A practitioner's guide to cluster-robust inference.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.models.dynamic.noise import Whitener, spectrum, without_spikes
from app.diagnosis.regression.solved import Weights
from app.diagnosis.thresholds.evidence import GAIN_SPREAD
from app.diagnosis.thresholds.noise import FEWEST, MOST, STRETCH

if TYPE_CHECKING:
    from app.diagnosis.dynamic.names import Member
    from app.diagnosis.dynamic.study import Study
    from app.diagnosis.models.dynamic.samples import Samples

BLOCKS, FOLDS = 20, 5  # stretches of the log, and in how many turns they are left out
RENEWALS = 3


@dataclass(frozen=True, eq=False)
class Solution(Weights):
    """Weights of the selected columns.

    Args:
        plain: True where every sample counts alike.
        heldout: (M, n) residual of windows left out, everything linear refitted without them [Nm].
        whiteners: the weights.
        turns: its columns by stretches, for the same with some of them left out.
    """

    plain: bool
    heldout: np.ndarray
    whiteners: tuple[Whitener, ...]
    turns: _Turns = field(repr=False)


def solve(study: Study, *, plain: bool, held: Sequence[int] = (), gains: bool = True) -> Solution:
    """Solves for the selection of a study.

    Args:
        held: groups whose columns stay out: they stand where the hypothesis has them.
        plain: True weights every sample alike.
        gains: False for values that are compared with those of the same drives: their gains cancel.
    """
    columns, precision = _columns(study, held)
    parts, whiteners, weights, inverse = _solved(study, columns, precision, plain)
    covariance = inverse
    if plain:
        covariance = _sandwich(study, parts, weights, inverse, precision)
        covariance += _of_gains(study, parts, inverse) if gains else 0.0
    turns = _Turns(study, parts, precision)
    heldout = turns.residual(np.ones(len(columns), bool))
    return Solution(columns, weights, covariance, plain, heldout, tuple(whiteners), turns)


def _solved(study: Study, columns: np.ndarray, precision: np.ndarray, plain: bool):
    """Parts, whiteners, weights and inverse of the normal matrix; of plain weights the noise is renewed."""
    parts = [_Part(study, j, columns) for j in range(study.design.joints)]
    whiteners = list(study.design.whiteners)
    weights, inverse = np.zeros(len(columns)), np.zeros((len(columns), len(columns)))
    for k in range(RENEWALS if plain else 1):
        if plain and k:
            whiteners = [p.plain(weights) for p in parts]
        elif plain:
            whiteners = [Whitener(w.spread) for w in whiteners]
        for part, whitener in zip(parts, whiteners, strict=True):
            part.whiten(whitener)
        gram, right = _sum(parts, len(columns))
        inverse = _inverse(gram + np.diag(precision))
        weights = inverse @ right
    return parts, whiteners, weights, inverse


def plain_noise(study: Study) -> tuple[np.ndarray, np.ndarray]:
    """(n,) noise [Nm] by which `solve` weighs every sample alike, and what its fit leaves (root mean square) [Nm]."""
    columns, precision = _columns(study)
    parts, whiteners, weights, _ = _solved(study, columns, precision, True)
    left = [float(np.sqrt(np.mean((p.y - p.raw @ weights[p.ids]) ** 2))) for p in parts]
    return np.array([w.spread for w in whiteners]), np.array(left)


def _inverse(matrix: np.ndarray) -> np.ndarray:
    """Inverse of a positive matrix whose columns differ in size."""
    if not len(matrix):
        return matrix
    size = 1.0 / np.sqrt(np.diag(matrix))
    values, vectors = np.linalg.eigh(matrix * size[:, None] * size)
    values = np.maximum(values, 1e-13 * values[-1])
    half = (vectors / np.sqrt(values)) * size[:, None]
    return half @ half.T


def _columns(study: Study, held: Sequence[int] = ()) -> tuple[np.ndarray, np.ndarray]:
    """Numbers of the selected columns and their prior precision."""
    found: dict[int, float] = {}
    for g, gamma in study.selection.items():
        if g in held:
            continue
        for c in study.group(g).columns.tolist():
            found[c] = max(found.get(c, 0.0), gamma)
    return np.array(sorted(found), int), np.array([1.0 / found[c] for c in sorted(found)])


class _Part:
    """One joint's share of the problem."""

    def __init__(self, study: Study, joint: int, columns: np.ndarray):
        ids = study.design.at[joint]
        at = {int(c): i for i, c in enumerate(columns)}
        here = [k for k, c in enumerate(ids.tolist()) if c in at]
        self.study, self.joint = study, joint
        self.ids = np.array([at[int(ids[k])] for k in here], int)
        self.raw = study.design.raw[joint][:, here]
        self.y = study.design.y[:, joint]

    def plain(self, weights: np.ndarray) -> Whitener:
        """White noise as loud as slow noise of this residual would be to a fit of slow columns."""
        left = self.y - self.raw @ weights[self.ids]
        found = spectrum(without_spikes(left), self.study.samples.step, self.study.band, len(self.ids) / 2.0)
        slow = float(np.mean(found.power[found.low])) if found.low.any() else float(np.mean(left**2))
        return Whitener(float(np.sqrt(max(slow, float(np.mean(left**2)), 1e-24))))

    def whiten(self, whitener: Whitener) -> None:
        self.whitener = whitener
        self.white, self.white_y = whitener(self.raw), whitener(self.y)


def _sum(parts: Sequence[_Part], size: int, rows: np.ndarray | None = None) -> tuple[np.ndarray, np.ndarray]:
    gram, right = np.zeros((size, size)), np.zeros(size)
    for part in parts:
        x, y = (part.white, part.white_y) if rows is None else (part.white[rows], part.white_y[rows])
        gram[np.ix_(part.ids, part.ids)] += x.T @ x
        right[part.ids] += x.T @ y
    return gram, right


def _sandwich(study, parts, weights, inverse, precision) -> np.ndarray:
    rows = len(parts[0].white)
    count = int(np.clip(study.state.seconds / STRETCH, FEWEST, MOST))
    edges = np.linspace(0, rows, count + 1).astype(int)[:-1]
    scores = np.zeros((count, len(weights)))
    for part in parts:
        left = part.white_y - part.white @ weights[part.ids]
        scores[:, part.ids] += np.add.reduceat(part.white * left[:, None], edges, axis=0)
    meat = scores.T @ scores * count / (count - 1)
    robust = inverse @ (meat + np.diag(precision)) @ inverse
    # A direction that few stretches show is not better known than if the noise were as stated.
    larger = np.sqrt(np.maximum(np.diag(inverse) / np.maximum(np.diag(robust), 1e-300), 1.0))
    return robust * larger[:, None] * larger


def _of_gains(study: Study, parts: Sequence[_Part], inverse: np.ndarray) -> np.ndarray:
    """What drive gains as they are made add to the covariance where they are not fitted.

    A gain that is off by a share scales its joint's torque; against another log of the same drives only what changed.
    Each is a parameter that is considered: Schmidt (1966), Application of state-space methods to navigation problems.
    """
    if any(study.label(g).law.gain for g in study.selection):
        return np.zeros_like(inverse)
    scaled = study.state.drive if study.prior is None else study.y
    moved = [inverse[:, p.ids] @ (p.white.T @ p.whitener(scaled[:, p.joint])) for p in parts]
    return GAIN_SPREAD**2 * sum((np.outer(v, v) for v in moved), np.zeros_like(inverse))


def folds_of(count: int) -> np.ndarray:
    """(count,) turn in which each row is left out: stretches of time in turn."""
    return (np.arange(count) * BLOCKS // max(count, 1)) % FOLDS


def parts_of(count: int) -> np.ndarray:
    """(count,) the same where a whole part of the log is left out at once."""
    return np.arange(count) * FOLDS // max(count, 1)


class _Turns:
    """Products of the whitened columns stretch by stretch: what any part of them predicts where it has not learnt."""

    def __init__(self, study: Study, parts: Sequence[_Part], precision: np.ndarray):
        self.study, self.parts, self.precision = study, parts, precision
        rows = len(parts[0].white)
        self.folds = folds_of(len(study.y))
        self.whole, self.right = _sum(parts, len(precision))
        seen = self.folds[len(study.y) - rows :]
        self.own = [_sum(parts, len(precision), np.flatnonzero(seen == k)) for k in range(FOLDS)]

    def residual(self, kept: np.ndarray) -> np.ndarray:
        """(M, n) residual of windows left out, some of the columns (a,) fitted to the others [Nm]."""
        study, inside = self.study, np.flatnonzero(kept)
        weights = np.zeros((len(self.precision), FOLDS))
        for k, (gram, own) in enumerate(self.own):
            block = (self.whole - gram)[np.ix_(inside, inside)] + np.diag(self.precision[inside])
            weights[inside, k] = _inverse(block) @ (self.right - own)[inside]
        out = study.y - study.design.y
        for part in self.parts:
            fitted = part.raw @ weights[part.ids]  # of every turn, of which each row takes its own
            out[:, part.joint] += part.y - fitted[np.arange(len(fitted)), self.folds]
        return out


def error_with(samples: Samples, chosen: Sequence[Member], known: np.ndarray) -> float:
    """Held-out root mean square [Nm] of laws fitted to windows under any hypothesis, every sample alike.

    Args:
        known: (M, n) torque that is taken for part of the description [Nm].
    """
    state, y = samples.state, samples.y - samples.description - known
    folds = folds_of(len(y))
    columns, precision = [], []
    for m in chosen:
        found = m.candidate.law.columns(state, m.candidate.place)
        widths = m.candidate.law.widths(state, m.candidate.place) if found else np.zeros(0)
        columns.append((found, widths))
        precision += [1.0] * len(widths)
    size = len(precision)
    out = np.zeros_like(y)
    scale = np.maximum(np.std(y, axis=0), 1e-9)
    parts = []
    for j in range(y.shape[1]):
        ids, blocks, at = [], [], 0
        for found, widths in columns:
            if j in found:
                ids.append(np.arange(at, at + len(widths)))
                blocks.append(found[j] * widths)
            at += len(widths)
        X = np.concatenate(blocks, axis=1) if blocks else np.zeros((len(y), 0))
        parts.append((np.concatenate(ids) if ids else np.zeros(0, int), X))
    for k in range(FOLDS):
        rest = folds != k
        gram, right = np.diag(np.full(size, 1e-4)), np.zeros(size)
        for j, (ids, X) in enumerate(parts):
            x, own = X[rest] / scale[j], y[rest, j] / scale[j]
            gram[np.ix_(ids, ids)] += x.T @ x
            right[ids] += x.T @ own
        weights = _inverse(gram) @ right if size else right
        for j, (ids, X) in enumerate(parts):
            out[~rest, j] = y[~rest, j] - X[~rest] @ weights[ids]
    left = samples.state.hypothesis.recorded(out)
    return float(np.sqrt(np.mean(left[samples.used] ** 2) + np.mean(samples.within)))


def surprise(study: Study, solution: Solution, out: np.ndarray) -> tuple[float, float]:
    """How far the values of another log must move for this one where some columns are taken out and the rest refitted.

    Returns:
        Half the sum of squares of the moves, in their standard deviations there [nats]; and the rows of one joint that
        count here, by which it is as much as nepers of this log's error.
    """
    kept = ~np.isin(solution.columns, out)
    turns, inside = solution.turns, np.flatnonzero(kept)
    block = turns.whole[np.ix_(inside, inside)] + np.diag(turns.precision[inside])
    weights = _inverse(block) @ turns.right[inside]
    prior = [study.group(g).columns for g in study.selection if study.label(g).law.certain]
    moved = np.isin(solution.columns[inside], np.concatenate([np.zeros(0, int), *prior]))
    counts = [float(np.sum((p.white_y - p.white @ solution.weights[p.ids]) ** 2)) for p in turns.parts]
    return 0.5 * float(weights[moved] @ weights[moved]), max(float(np.mean(counts)), 1.0)


def heldout_without(
    study: Study, solution: Solution, columns: np.ndarray, added: np.ndarray | None = None
) -> np.ndarray:
    """(M, n) residual of windows left out, some columns taken out and the rest refitted [Nm].

    Args:
        added: (M, n) torque that is no longer taken for part of the description [Nm].
    """
    kept = ~np.isin(solution.columns, columns)
    if added is None:
        return solution.turns.residual(kept)
    every, both = solution.columns, dict(zip(*(a.tolist() for a in _columns(study)), strict=True))
    precision = np.array([both[int(c)] for c in every])
    parts = [_Part(study, j, every[kept]) for j in range(study.design.joints)]
    for part, whitener in zip(parts, solution.whiteners, strict=True):
        if added is not None:
            part.y = part.y + added[:, part.joint]
        part.whiten(whitener)
    return _Turns(study, parts, precision[kept]).residual(np.ones(int(kept.sum()), bool))
