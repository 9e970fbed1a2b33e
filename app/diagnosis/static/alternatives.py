"""Other explanations of a finding that the recording cannot rule out."""

from __future__ import annotations

import numpy as np

from app.diagnosis.result import Alternative
from app.diagnosis.static.fit import Fitted
from app.diagnosis.static.library import Candidate, library
from app.diagnosis.static.looking import key_of, score_all, without
from app.diagnosis.static.score import basis

#: Difference of BIC within which two models are not told apart (a Bayes factor of 100).
MARGIN = 9.2
MOST = 8


def overruled(alternatives: tuple[Alternative, ...]) -> bool:
    """True where something else explains the data so much better that the name cannot stand.

    The search takes the best it can name; what it cannot name, because base and tool hide nearly all of it, may
    still be the better explanation.
    """
    return any(other.delta_bic < -MARGIN for other in alternatives)


def alternatives_of(fitted: Fitted, index: int, wanted: tuple[Candidate, ...]) -> tuple[Alternative, ...]:
    """Candidates that, put in the place of term `index`, come within `MARGIN` of it."""
    jacobian, white = without(fitted, index)
    base = basis(jacobian)
    scores = score_all(fitted, library(fitted.columns, wanted, fitted.ghosts), base, None, white)
    term = fitted.terms[index]
    rest = white - base.q @ (base.q.T @ white)
    rss, n = float(rest @ rest), fitted.size
    mine = fitted.rss
    parameters = len(term.values)
    delta = n * np.log(np.maximum(rss - scores.gain, 1e-300) / mine) + (scores.size - parameters) * np.log(n)
    taken = {key_of(t.effect.key, t.where) for t in fitted.terms}
    out: list[Alternative] = []
    for at in np.argsort(delta):
        candidate = scores.candidates[at]
        label = key_of(candidate.effect.key, candidate.place.where)
        if delta[at] > MARGIN or len(out) == MOST:
            break
        if label in taken:
            continue
        taken.add(label)
        out.append(Alternative(candidate.effect.key, dict(candidate.place.where), float(delta[at])))
    return tuple(out)
