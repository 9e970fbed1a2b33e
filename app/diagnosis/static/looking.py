"""The library held against what a fit leaves, and a fit without some of its terms."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from app.diagnosis.static.effect import without_row
from app.diagnosis.static.fit import Fitted, Term, fit
from app.diagnosis.static.library import Candidate, Library
from app.diagnosis.static.score import Basis, Scores, basis, score_library

#: Share of an effect's signature that base, tool and the rest must leave for it to be named.
LEAST_VISIBLE = 0.05
#: Rows between two steps of one kind that are strays rather than a time of their own.
STRAY_ROWS = 2


def new_term(candidate: Candidate, fitted: Fitted) -> Term:
    """The candidate as a term that starts from nothing."""
    count = len(candidate.effect.quantities(fitted.recording.situation, candidate.place))
    return Term(candidate.effect, candidate.place, np.zeros(count))


def with_candidate(now: Fitted, candidate: Candidate) -> Fitted | None:
    """The fit with the candidate beside what is in; None where it ends on a physical bound."""
    terms = (*now.terms, new_term(candidate, now))
    trial = fit(now.recording, now.setup, terms, now.weights, held=now.held)
    return None if at_bound(trial, len(terms) - 1) else trial


def score_all(
    fitted: Fitted, lib: Library, base: Basis, signs: np.ndarray | None, white: np.ndarray | None = None
) -> Scores:
    """Scores of the whole library on what the fit leaves."""
    recording = fitted.recording
    rest = fitted.white if white is None else white
    rest = rest - base.q @ (base.q.T @ rest)
    dof = max(fitted.size - base.q.shape[1], 2)
    order = np.concatenate([recording.situation.order, np.zeros(fitted.ghosts)])
    return score_library(lib, base, rest, fitted.rows, dof, signs, order)


def with_ghosts(pose: np.ndarray, ghosts: int) -> np.ndarray:
    """Numbers of the poses, every ghost row one of its own."""
    return np.concatenate([pose, pose.max() + 1 + np.arange(ghosts)])


def key_of(key: str, where) -> tuple:
    """Identity of a finding for "is it in already": steps of one kind may recur at another row."""
    return (key, *sorted((k, v) for k, v in where.items()))


def taken_already(candidate: Candidate, terms: Sequence[Term]) -> bool:
    """True where the candidate is in, or a step of its kind a row or two away: what lies between is a stray row."""
    key, row = _without_row(candidate.effect.key, candidate.place.where)
    for term in terms:
        other, begins = _without_row(term.effect.key, term.where)
        if other == key and (row == begins or (row and begins and abs(row - begins) <= STRAY_ROWS)):
            return True
    return False


def _without_row(key: str, where) -> tuple[tuple, int | None]:
    return key_of(key, without_row(where)), where.get("from_row")


def at_bound(fitted: Fitted, index: int) -> bool:
    """True where a fitted value sits on a physical bound, which means the effect has the wrong sign."""
    term = fitted.terms[index]
    quantities = term.effect.quantities(fitted.recording.situation, term.place)
    return any(v <= q.lower or v >= q.upper for v, q in zip(term.values, quantities, strict=True))


def without(fitted: Fitted, *indices: int) -> tuple[np.ndarray, np.ndarray]:
    """Jacobian without the terms `indices`, and the residual with their share put back."""
    keep = np.ones(fitted.jacobian.shape[1], bool)
    white = fitted.white.copy()
    for index in indices:
        where = fitted.slices[index]
        keep[where] = False
        white += fitted.jacobian[:, where] @ fitted.terms[index].values
    return fitted.jacobian[:, keep], white


def visible_share(fitted: Fitted, index: int) -> float:
    """Share of the term's signature that nothing else in the fit can imitate."""
    where = fitted.slices[index]
    block = fitted.jacobian[:, where] @ fitted.terms[index].values
    if not np.any(block):
        block = fitted.jacobian[:, where].sum(axis=1)
    rest = basis(without(fitted, index)[0]).project(block[:, None])[:, 0]
    return float(np.clip(np.linalg.norm(rest) / max(float(np.linalg.norm(block)), 1e-300), 0.0, 1.0))
