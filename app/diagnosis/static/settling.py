"""Terms that are in already, moved to where they explain more: one at a time, and two at once."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from app.diagnosis.static.effect import without_row
from app.diagnosis.static.fit import Fitted, Term, fit
from app.diagnosis.static.library import Candidate, library
from app.diagnosis.static.looking import (
    LEAST_VISIBLE,
    at_bound,
    key_of,
    new_term,
    score_all,
    visible_share,
    without,
)
from app.diagnosis.static.pairs import rival_pairs
from app.diagnosis.static.score import Basis, basis, significance

_BETTER = 0.5  # difference of -log10 p that makes a swap worth a fit
#: BIC that two others must gain before two terms make way for them: less is what many pairs gain by chance.
EXCHANGE = 2.0


def settle(now: Fitted, wanted: tuple[Candidate, ...], passes: int = 4) -> Fitted:
    """Swaps each term for a better one at another place, and puts every step at its best row, until none moves."""
    if not [t for t in now.terms if not t.tacit]:
        return now
    for _ in range(passes):
        changed = False
        for index, term in enumerate(now.terms):
            if term.tacit:
                continue
            better = _better(now, index, wanted)
            if better is not None:
                now, changed = better, True
        if not changed:
            break
    return now


def _better(now: Fitted, index: int, wanted: tuple[Candidate, ...]) -> Fitted | None:
    jacobian, white = without(now, index)
    base = basis(jacobian)
    scores = score_all(now, library(now.columns, wanted, now.ghosts), base, None, white)
    term = now.terms[index]
    mine = _own_score(now, index, base, white)
    others = {key_of(t.effect.key, t.where) for i, t in enumerate(now.terms) if i != index}
    for at in scores.order()[:3]:
        candidate = scores.candidates[at]
        label = key_of(candidate.effect.key, candidate.place.where)
        if label in others or label == key_of(term.effect.key, term.where):
            continue
        if scores.visible[at] < LEAST_VISIBLE:
            continue
        margin = 0.01 if _same_but_row(candidate, term) else _BETTER
        if "from_row" in candidate.place.where and "from_row" not in term.where:
            margin = max(margin, float(np.log10(now.rows)))  # the row was chosen among as many
        if scores.score[at] < mine + margin:
            return None
        terms = list(now.terms)
        terms[index] = new_term(candidate, now)
        trial = fit(now.recording, now.setup, tuple(terms), now.weights, held=now.held)
        if not at_bound(trial, index) and trial.bic < now.bic - 1e-6:
            return trial
    return None


def _same_but_row(candidate: Candidate, term: Term) -> bool:
    return candidate.effect is term.effect and without_row(candidate.place.where) == without_row(term.where)


def _own_score(now: Fitted, index: int, base: Basis, white: np.ndarray) -> float:
    """-log10 p of the term that sits there now, by the same measure as its rivals."""
    block = base.project(now.jacobian[:, now.slices[index]])
    rest = white - base.q @ (base.q.T @ white)
    own = basis(block)
    gain = float(np.sum((own.q.T @ rest) ** 2))
    dof = max(now.size - base.q.shape[1], 2)
    return float(significance(np.array(gain), float(rest @ rest), block.shape[1], dof))


def exchanged(now: Fitted, wanted: tuple[Candidate, ...]) -> Fitted | None:
    """Two terms changed for two others that explain clearly more together; None where none do."""
    named = [i for i, term in enumerate(now.terms) if not term.tacit]
    for pair in combinations(named, 2):
        rest = {key_of(t.effect.key, t.where) for i, t in enumerate(now.terms) if i not in pair}
        mine = {key_of(now.terms[i].effect.key, now.terms[i].where) for i in pair}
        for rivals in rival_pairs(now, pair, wanted, 3):
            if rivals.delta > -EXCHANGE:
                break
            labels = {key_of(c.effect.key, c.place.where) for c in (rivals.first, rivals.second)}
            if labels & rest or labels == mine:
                continue
            terms = list(now.terms)
            for index, candidate in zip(pair, (rivals.first, rivals.second), strict=True):
                terms[index] = new_term(candidate, now)
            trial = fit(now.recording, now.setup, tuple(terms), now.weights, held=now.held)
            # Each of the two may be seen well beside the other terms and hardly at all beside its companion.
            seen = all(visible_share(trial, i) >= LEAST_VISIBLE and not at_bound(trial, i) for i in pair)
            if seen and trial.bic < now.bic - EXCHANGE:
                return trial
    return None
