"""Two effects that hide each other: neither stands while the other is still in the residual.

What a step leaves behind looks like errors that remember, and beside such errors nothing else can be told from
chance; and a strong effect drowns the rows left out. So where the best candidate would beat chance and yet does
not stand, it is put in for a trial: if a second one stands beside it, and something stands beside that second
one in its turn, both are taken.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from app.diagnosis.static.chance import Chance
from app.diagnosis.static.effect import without_row
from app.diagnosis.static.fit import Fitted, Term, fit
from app.diagnosis.static.library import Candidate
from app.diagnosis.static.looking import LEAST_VISIBLE, key_of, taken_already, with_candidate
from app.diagnosis.static.noise import weights_from
from app.diagnosis.static.ranking import by_rank
from app.diagnosis.static.score import Scores

#: Laws that are put in for a trial before it is given up.
FIRSTS = 3

Taken = tuple[Fitted, float]
Take = Callable[[Fitted, Scores, Chance], Taken | None]


def two_at_once(now: Fitted, scores: Scores, chance: Chance, take: Take) -> tuple[Fitted, list[float]] | None:
    """The fit with two more terms, each of which stands beside the other, and their p; None where there are none.

    Args:
        scores: of the library on what `now` leaves.
        take: the fit with the best candidate that stands.
    """
    tried: set[tuple] = set()
    for index in by_rank(scores, now.rows):
        if not scores.p_value(index) <= chance.level or len(tried) == FIRSTS:
            return None
        first = scores.candidates[index]
        if (
            scores.visible[index] < LEAST_VISIBLE
            or kind_of(first) in tried
            or taken_already(first, now.terms)
        ):
            continue
        tried.add(kind_of(first))
        trial = with_candidate(now, first)
        if trial is None:
            continue
        trial = fit(trial.recording, trial.setup, trial.terms, weights_from(trial), held=trial.held)
        second = take(trial, chance.scores(trial), chance)
        if second is None:
            continue
        # The second by itself: what stands beside it need not be what it was found beside.
        terms = (*now.terms, second[0].terms[-1])
        alone = fit(now.recording, now.setup, terms, second[0].weights, held=now.held)
        both = take(alone, chance.scores(alone), chance)
        if both is not None and not _one_law(both[0].terms[-2:]):
            return both[0], [second[1], both[1]]
    return None


def _one_law(terms: Sequence[Term]) -> bool:
    """True for two on one joint: where neither stands alone they are likelier one law without a name.

    What another joint drives is no part of such a law.
    """
    joints = [term.where.get("joint") for term in terms]
    alone = not any("source_joint" in term.where for term in terms)
    return alone and joints[0] is not None and joints[0] == joints[1]


def kind_of(candidate: Candidate) -> tuple:
    """A candidate's identity; the row of a step does not count."""
    place = candidate.place
    return (*key_of(candidate.effect.key, without_row(place.where)), tuple(sorted(place.fixed.items())))
