"""An arm as it was built: every length, twist and zero a little off, expected to be small, none of it a finding.

The sizes are not given but learnt: the spread of all geometric errors is the one under which the recording is
most probable (empirical Bayes). So an arm with tiny errors everywhere costs one number, not thirty.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.linalg import qr

from app.diagnosis.static.fit import Fitted, Term, fit
from app.diagnosis.static.library import GEOMETRY, candidates, library
from app.diagnosis.static.noise import weights_from
from app.diagnosis.static.score import basis

#: Radians of twist or zero that go with a metre of length: a millimetre at the end of one metre.
RAD_PER_M = 1.0
#: Share of a unit column that must be left for its parameter to be told from those before it.
INDEPENDENT = 0.02
_START = 3e-4  # m
_ROUNDS = 6


def geometry_terms(fitted: Fitted) -> tuple[Term, ...]:
    """Geometric parameters that this recording can tell from base, tool and each other, best seen first."""
    situation = fitted.recording.situation
    wanted = tuple(c for c in candidates(situation) if c.effect.key in GEOMETRY)
    matrix = library(fitted.columns, wanted).matrix
    raw = np.linalg.norm(matrix, axis=0)
    plain = fitted.jacobian[: len(matrix), : fitted.slices[0].start if fitted.slices else None]
    projected = basis(plain).project(matrix) / np.where(raw > 0, raw, 1.0)
    _, r, pivots = qr(projected, mode="economic", pivoting=True)  # pyright: ignore[reportAssignmentType]
    seen = np.abs(np.diag(r)) > INDEPENDENT
    chosen = sorted(pivots[: len(seen)][seen])
    return tuple(
        Term(wanted[i].effect, wanted[i].place, np.zeros(1), tacit=True, spread=_START) for i in chosen
    )


def _unit(term: Term) -> float:
    """Size of this parameter relative to the common spread [m]."""
    return 1.0 if term.effect.key == "link_length" else RAD_PER_M


def fit_as_built(plain: Fitted, terms: tuple[Term, ...] = ()) -> Fitted:
    """The fit with all geometry in, its spread learnt; `terms` are fitted beside it."""
    geometry = geometry_terms(plain)
    now = fit(plain.recording, plain.setup, (*geometry, *terms), plain.weights, held=plain.held)
    return relearnt(now)


def relearnt(now: Fitted, rounds: int = _ROUNDS) -> Fitted:
    """The same terms with the common spread of the geometry learnt anew, by expectation and maximisation."""
    for _ in range(rounds):
        now = fit(now.recording, now.setup, now.terms, weights_from(now), held=now.held)
        inverse = np.linalg.pinv(now.jacobian.T @ now.jacobian, hermitian=True)
        noise = now.rss / now.dof
        total, count = 0.0, 0
        for term, where in zip(now.terms, now.slices, strict=True):
            if np.isfinite(term.spread):
                unit = _unit(term)
                total += float(np.sum(term.values**2) + noise * np.trace(inverse[where, where])) / unit**2
                count += len(term.values)
        spread = max(float(np.sqrt(total / max(count, 1))), 1e-9)
        old = next((t.spread / _unit(t) for t in now.terms if np.isfinite(t.spread)), spread)
        terms = tuple(replace(t, spread=spread * _unit(t)) if np.isfinite(t.spread) else t for t in now.terms)
        now = fit(now.recording, now.setup, terms, now.weights, held=now.held)
        if abs(np.log(spread / old)) < 0.05:
            break
    return now


def evidence(fitted: Fitted) -> float:
    """-2 log of the probability of the recording under the model, up to a constant; comparable with a BIC.

    Expected sizes are integrated out; free parameters cost log n each, as in the BIC.
    """
    n = int(np.count_nonzero(fitted.weights))
    # Whitening differs between fits: what is compared is the residual in metres and radians.
    log_weights = float(np.sum(np.log(fitted.weights[fitted.weights > 0])))
    ghost = np.zeros(fitted.jacobian.shape[1], bool)
    spreads = []
    for term, where in zip(fitted.terms, fitted.slices, strict=True):
        if np.isfinite(term.spread):
            ghost[where] = True
            spreads += [term.spread] * len(term.values)
    free = int(np.count_nonzero(~ghost))
    value = n * np.log(max(fitted.rss, 1e-300) / n) + free * np.log(n) - 2.0 * log_weights
    if spreads:
        real = fitted.jacobian[: fitted.weights.size]
        projected = basis(real[:, ~ghost]).project(real[:, ghost]) * np.array(spreads)
        noise = fitted.rss / fitted.dof
        gram = projected.T @ projected / noise
        value += float(np.linalg.slogdet(np.eye(len(spreads)) + gram)[1]) + np.log(n)
    return float(value)


def spread_of(fitted: Fitted) -> float:
    """The learnt one-sigma size of a geometric error [m]; 0 where none was fitted."""
    return next((t.spread / _unit(t) for t in fitted.terms if np.isfinite(t.spread)), 0.0)
