"""The arm as a reference run showed it: what is known of it before the new run is looked at.

Its laws and masses become nuisance with the reference's own uncertainty; where both runs follow the same
path, what the reference left unexplained is taken away as well, instant by instant.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.motion.errors import raw_columns
from app.diagnosis.motion.sampling import Samples
from app.diagnosis.motion.search import Term
from app.diagnosis.motion.system import System
from app.diagnosis.wording import note

if TYPE_CHECKING:
    from app.diagnosis.motion.corrections import Corrections
    from app.diagnosis.motion.study import Study

SAME_PATH = 0.02  # rad or m: two runs this near to each other, all the time, follow one path
LARGEST_LAG = 0.5  # share of the shorter run


@dataclass(frozen=True, eq=False)
class Baseline:
    """A reference run's model.

    Args:
        terms: what was found in it, events left out.
        theta: (p,) inertial, then the terms' coefficients.
        information: (p, p) on them.
        residual: (M, n) [Nm] what the reference left, at times t (M,) with positions q (M, n).
        corrections: what its samples were corrected for.
    """

    terms: list[Term]
    theta: np.ndarray
    information: np.ndarray
    t: np.ndarray
    q: np.ndarray
    residual: np.ndarray
    usable: np.ndarray
    corrections: Corrections


def baseline_of(study: Study) -> Baseline:
    """What the reference teaches, its uncertainty widened by what it leaves unexplained."""
    solution, system = study.fit.solution, study.system
    lasting = [
        i
        for i, t in enumerate(study.fit.terms)
        if t.group.law is not None and not t.group.law.windowed and not t.group.law.corrected
    ]
    keep, at = [np.arange(system.inertial_size)], system.inertial_size
    terms = []
    for i, term in enumerate(study.fit.terms):
        linear = len(term.group.law.linear) if term.group.law is not None else 0
        if i in lasting:
            keep.append(np.arange(at, at + linear))
            terms.append(term)
        at += term.group.size
    index = np.concatenate(keep)
    rows = max(system.rows, 1)
    widening = max(solution.rss / rows, 1.0)
    covariance = solution.covariance[np.ix_(index, index)] * widening
    scale = np.sqrt(np.diag(covariance))
    information = np.linalg.pinv(covariance / scale / scale[:, None], rcond=1e-12, hermitian=True)
    information = information / scale / scale[:, None]
    residual = study.samples.y - study.fit.offset
    for j, (columns, pos) in enumerate(
        zip(raw_columns(system, solution.selected), solution.positions, strict=True)
    ):
        residual[:, j] -= columns @ solution.theta[pos]
    return Baseline(
        terms,
        solution.theta[index],
        0.5 * (information + information.T),
        study.samples.t,
        study.samples.pool(study.samples.state.q),
        residual,
        study.samples.usable,
        study.corrections,
    )


def without_baseline(samples: Samples, base: Baseline) -> tuple[Samples, str]:
    """The samples with the reference's model, and on the same path its residual, taken away; and a note."""
    y = samples.y.copy()
    nuisance = len(base.theta) - sum(len(_law(t).linear) for t in base.terms)
    for j in range(y.shape[1]):
        y[:, j] -= samples.regressor[:, :, j] @ base.theta[:nuisance]
    at = nuisance
    for term in base.terms:
        law, group = _law(term), term.group
        columns = samples.pool(law.columns(samples.state, group.where, group.shape))
        part = columns @ base.theta[at : at + columns.shape[-1]]
        at += columns.shape[-1]
        if group.joint is None:
            y -= part
        else:
            y[:, group.joint] -= part
    lag = _lag(samples, base)
    if lag is None:
        return replace(samples, y=y), note("other_path")
    when = samples.t - lag
    inside = (when >= base.t[0]) & (when <= base.t[-1])
    usable = samples.usable & inside[:, None]
    for j in range(y.shape[1]):
        y[:, j] -= np.interp(when, base.t, base.residual[:, j])
        usable[:, j] &= np.interp(when, base.t, base.usable[:, j].astype(float)) > 0.999
    return replace(samples, y=y, usable=usable), note("same_path", lag=lag)


def known_terms(system: System, base: Baseline) -> list[Term]:
    """The reference's terms among this system's columns, in the order of `base.theta`."""
    out = []
    for term in base.terms:
        law = _law(term)
        columns = system.samples.pool(law.columns(system.samples.state, term.group.where, term.group.shape))
        group = replace(term.group, size=columns.shape[-1], bent=False, name="reference")
        out.append(replace(term, group=system.append(group, columns)))
    return out


def _law(term: Term):
    assert term.group.law is not None
    return term.group.law


def _lag(samples: Samples, base: Baseline) -> float | None:
    """How much later this run passes where the reference did, or None where the paths differ."""
    q = samples.pool(samples.state.q)
    step = max(samples.step, float(np.median(np.diff(base.t))))
    grid, other = np.arange(0, samples.t[-1], step), np.arange(0, base.t[-1], step)
    a = np.stack([np.interp(grid, samples.t, c) for c in q.T], axis=1)
    b = np.stack([np.interp(other, base.t, c) for c in base.q.T], axis=1)
    most = int(LARGEST_LAG * min(len(a), len(b)))
    best, best_lag = np.inf, 0
    for coarse in (max(most // 60, 1), 1):
        around = range(-most, most + 1, coarse) if coarse > 1 or best == np.inf else ()
        if coarse == 1 and best < np.inf:
            span = max(most // 60, 1)
            around = range(best_lag - span, best_lag + span + 1)
        for lag in around:
            x, z = (a[lag:], b) if lag >= 0 else (a, b[-lag:])
            count = min(len(x), len(z))
            if count < 30:
                continue
            miss = float(np.sqrt(np.mean((x[:count] - z[:count]) ** 2)))
            if miss < best:
                best, best_lag = miss, lag
    return best_lag * step if best < SAME_PATH else None
