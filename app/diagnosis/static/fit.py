"""Fits everything that is free at once, with the exact forward model: setup and effects."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from app.diagnosis.static.cell import Cell, Posed, nominal_cell, pose
from app.diagnosis.static.effect import Place, StaticEffect
from app.diagnosis.static.nuisance import nuisance_columns
from app.diagnosis.static.recording import StaticRecording
from app.diagnosis.static.sensitivity import Sensitivity, sensitivity
from app.diagnosis.static.setup import Setup, moved, residual
from app.diagnosis.static.situation import Situation

_TINY = 1e-12  # relative length of a column below which it is nothing
NOTHING = (
    1e-13  # of the sum of squares: a step that promises less is none, a hundred-thousandth of a sigma at most
)
_STIFF = 1e-9  # relative eigenvalue of the scaled Hessian below which a direction is left alone


@dataclass(frozen=True, eq=False)
class Term:
    """An effect at a place, with values.

    Args:
        values: (d,) SI, in the order of the effect's quantities.
        tacit: True for what is only fitted so that it does not disturb; it is no finding.
        spread: one-sigma size [SI] it is expected to have at most, infinite where nothing is expected.
    """

    effect: StaticEffect
    place: Place
    values: np.ndarray
    tacit: bool = False
    spread: float = np.inf

    @property
    def where(self) -> Mapping[str, Any]:
        return self.place.where

    @property
    def label(self) -> tuple:
        """Hashable identity: key and place."""
        return (self.effect.key, *sorted(self.where.items()), *sorted(self.place.fixed.items()))


def apply_terms(situation: Situation, terms: tuple[Term, ...]) -> Cell:
    """The cell with all these effects in it."""
    cell = nominal_cell(situation)
    for term in terms:
        cell = term.effect.apply(cell, situation, term.place, term.values)
    return cell


@dataclass(frozen=True, eq=False)
class Fitted:
    """A fit and all that follows from it at its solution.

    Args:
        recording, setup, terms, weights: the state; terms carry fitted values. `held` are not fitted.
        residual: (m, k) measured minus predicted, SI.
        white: (N,) whitened, rows times components; then ghost rows, which hold the expected sizes.
        jacobian: (N, p) whitened columns: setup first, then terms in order.
        ghosts: number of ghost rows behind the recorded ones.
        slices: where each term's columns stand.
        columns: elementary columns at the solution.
        size: number of measured components.
    """

    recording: StaticRecording
    setup: Setup
    terms: tuple[Term, ...]
    held: tuple[Term, ...]
    weights: np.ndarray
    cell: Cell
    posed: Posed
    residual: np.ndarray
    white: np.ndarray
    jacobian: np.ndarray
    slices: tuple[slice, ...]
    columns: Sensitivity
    size: int
    ghosts: int
    converged: bool

    @property
    def rows(self) -> int:
        """Recorded rows and ghosts."""
        return self.recording.size + self.ghosts

    @property
    def real(self) -> np.ndarray:
        """(m, k) whitened residual of the recorded rows."""
        m, k = self.weights.shape
        return self.white[: m * k].reshape(m, k)

    @property
    def rss(self) -> float:
        return float(self.white @ self.white)

    @property
    def dof(self) -> int:
        return max(self.size - self.jacobian.shape[1], 1)

    @property
    def bic(self) -> float:
        """Bayesian information criterion of the Gaussian model with unknown noise."""
        return float(
            self.size * np.log(max(self.rss, 1e-300) / self.size) + self.jacobian.shape[1] * np.log(self.size)
        )


def fit(
    recording: StaticRecording,
    setup: Setup,
    terms: tuple[Term, ...],
    weights: np.ndarray,
    *,
    held: tuple[Term, ...] = (),
    iterations: int = 12,
) -> Fitted:
    """Gauss-Newton from the given state; a step that does not help is halved.

    Args:
        held: effects that are applied as they are.
    """
    now = _state(recording, setup, terms, weights, held)
    converged = False
    for _ in range(iterations):
        step = solve(now.jacobian, now.white)
        if now.white @ (now.jacobian @ step) <= NOTHING * now.rss:
            converged = True
            break
        scale, better = 1.0, None
        for _ in range(6):
            trial = _stepped(now, scale * step)
            if np.isfinite(trial.rss) and trial.rss <= now.rss * (1.0 + 1e-12):
                better = trial
                break
            scale *= 0.5
        if better is None:
            converged = True
            break
        gained = now.rss - better.rss
        now = better
        if gained <= 1e-7 * now.rss + 1e-18 * now.size:
            converged = True
            break
    return replace(now, converged=converged)


def solve(jacobian: np.ndarray, white: np.ndarray) -> np.ndarray:
    """Least-squares step; columns are scaled, directions nobody sees stay at zero."""
    scale = np.sqrt(np.einsum("np,np->p", jacobian, jacobian))
    scale = np.where(scale > _TINY * max(scale.max(initial=0.0), 1e-300), scale, np.inf)
    scaled = jacobian / scale
    gram, right = scaled.T @ scaled, scaled.T @ white
    stiff = gram.copy()
    stiff[np.diag_indices_from(stiff)] -= _STIFF
    try:
        np.linalg.cholesky(stiff)  # every eigenvalue is above
    except np.linalg.LinAlgError:
        values, vectors = np.linalg.eigh(gram)
        half = vectors[:, values > _STIFF]
        return (half @ ((half.T @ right) / values[values > _STIFF])) / scale
    return np.linalg.solve(gram, right) / scale


def _state(recording, setup, terms, weights, held) -> Fitted:
    cell = apply_terms(recording.situation, (*held, *terms))
    posed = pose(recording.situation, cell, setup.tool_rows(recording))
    rest = residual(recording, posed, setup, cell)
    columns = sensitivity(recording, posed, setup, cell, weights)
    m, k = weights.shape
    blocks = [nuisance_columns(recording, posed, columns)]
    slices, at = [], blocks[0].shape[2]
    for term in terms:
        block = term.effect.columns(columns, term.place)
        slices.append(slice(at, at + block.shape[2]))
        at += block.shape[2]
        blocks.append(block)
    jacobian = np.concatenate(blocks, axis=2).reshape(m * k, at)
    white = (rest * weights).reshape(-1)
    white, jacobian, expected = _with_ghosts(white, jacobian, terms, slices, k)
    return Fitted(
        recording, setup, tuple(terms), tuple(held), weights, cell, posed, rest, white, jacobian,
        tuple(slices), columns, int(np.count_nonzero(weights)) + expected, -(-expected // k), False,
    )  # fmt: skip


def _with_ghosts(white, jacobian, terms, slices, k: int):
    """Behind the recorded rows, one entry for every expected size: 0 = value / spread, filled up to whole rows."""
    entries = [(term, where) for term, where in zip(terms, slices, strict=True) if np.isfinite(term.spread)]
    count = sum(len(term.values) for term, _ in entries)
    if not count:
        return white, jacobian, 0
    filled = -(-count // k) * k
    more, rows = np.zeros(filled), np.zeros((filled, jacobian.shape[1]))
    at = 0
    for term, where in entries:
        d = len(term.values)
        more[at : at + d] = -term.values / term.spread
        rows[np.arange(at, at + d), np.arange(where.start, where.stop)] = 1.0 / term.spread
        at += d
    return np.concatenate([white, more]), np.concatenate([jacobian, rows]), count


def _stepped(now: Fitted, step: np.ndarray) -> Fitted:
    nuisance = now.slices[0].start if now.slices else now.jacobian.shape[1]
    setup = moved(now.setup, now.recording, step[:nuisance])
    terms = tuple(
        Term(t.effect, t.place, _bounded(t, now.recording.situation, t.values + step[at]), t.tacit, t.spread)
        for t, at in zip(now.terms, now.slices, strict=True)
    )
    return _state(now.recording, setup, terms, now.weights, now.held)


def _bounded(term: Term, situation: Situation, values: np.ndarray) -> np.ndarray:
    quantities = term.effect.quantities(situation, term.place)
    return np.array([min(max(v, q.lower), q.upper) for v, q in zip(values.tolist(), quantities, strict=True)])


def covariance(fitted: Fitted) -> np.ndarray:
    """(p, p) of the parameters, scaled by what the fit left over."""
    jacobian = fitted.jacobian
    scale = np.sqrt(np.einsum("np,np->p", jacobian, jacobian))
    scale = np.where(scale > 0, scale, 1.0)
    scaled = jacobian / scale
    inverse = np.linalg.pinv(scaled.T @ scaled, rcond=1e-10, hermitian=True)
    return fitted.rss / fitted.dof * inverse / scale[:, None] / scale
