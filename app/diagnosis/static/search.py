"""Which effects earn their place: taken one by one, each against chance and against rows left out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from app.diagnosis.static.chance import Chance
from app.diagnosis.static.effect import without_row
from app.diagnosis.static.fit import Fitted, fit
from app.diagnosis.static.heldout import heldout_loss
from app.diagnosis.static.library import Candidate
from app.diagnosis.static.looking import (
    LEAST_VISIBLE,
    taken_already,
    with_candidate,
    with_ghosts,
    without,
)
from app.diagnosis.static.noise import weights_from
from app.diagnosis.static.ranking import TRIES, by_rank
from app.diagnosis.static.scan import SCAN_ROWS, with_row
from app.diagnosis.static.score import Scores, basis, family_wise, flips
from app.diagnosis.static.serial import coloured_score
from app.diagnosis.static.settling import exchanged, settle
from app.diagnosis.static.together import two_at_once

#: A term is taken only where chance would do as well in at most this share of searches.
LEVEL = 0.005
MOST_TERMS = 6
MOST_EXCHANGES = 3
NULLS = 199
#: Share of the sum of squares that a large effect leaves at most.
LARGE = 0.5


@dataclass(frozen=True, eq=False)
class Found:
    """The outcome of a search.

    Args:
        fitted: with all terms in.
        p_values: family-wise, one a term.
        null: of the last round: the largest score of every sign-flipped residual.
    """

    fitted: Fitted
    p_values: tuple[float, ...]
    null: np.ndarray


def forward(
    start: Fitted,
    wanted: tuple[Candidate, ...],
    rng: np.random.Generator,
    *,
    nulls: int = NULLS,
    level: float = LEVEL,
    tick: Callable[[float, str], None] = lambda share, what: None,
) -> Found:
    """Takes terms while the best one beats chance and the rows left out agree."""
    now, p_values = start, []
    null = np.zeros(0)
    chance = Chance(wanted, rng, flips(rng, with_ghosts(start.recording.pose, start.ghosts), nulls), level)
    exchanges = 0
    while len(p_values) < MOST_TERMS:
        tick(len(p_values) / MOST_TERMS, "looking for what is missing")
        scores = chance.scores(now)
        null = scores.null
        taken = take(now, scores, chance)
        if taken is None:
            both = two_at_once(now, scores, chance, take)
            if both is not None:
                now, p_values = settle(both[0], wanted), p_values + both[1]
                now = exchanged(now, wanted) or now
                continue
            # Pairs are looked at when there are two terms, and once more when nothing else is to be had.
            other = exchanged(now, wanted) if exchanges < MOST_EXCHANGES else None
            if other is None:
                break
            now, exchanges = settle(other, wanted), exchanges + 1
            continue
        now, p_value = taken
        p_values.append(p_value)
        now = settle(refined(now), wanted)
        if len(p_values) == 2:
            now = exchanged(now, wanted) or now
    return Found(now, tuple(p_values), null)


def take(now: Fitted, scores: Scores, chance: Chance) -> tuple[Fitted, float] | None:
    """The fit with the best candidate that stands and its family-wise p, or None.

    Args:
        scores: of the library on what `now` leaves.
    """
    for index in by_rank(scores, now.rows)[:TRIES]:
        p_value = scores.p_value(index)
        if not p_value <= chance.level:
            return None
        candidate = scores.candidates[index]
        if scores.visible[index] < LEAST_VISIBLE or taken_already(candidate, now.terms):
            continue
        trial = with_candidate(now, candidate)
        if trial is None or not improves(now, trial):
            continue
        null = chance.in_stretches(trial)
        if null is not None:
            p_value = max(p_value, family_wise(scores.score[index], null))
            if p_value > chance.level:
                return None
        if follows_the_clock(candidate):
            score = coloured_score(trial, len(trial.terms) - 1)
            coloured = family_wise(score, scores.null)
            if coloured > chance.level and trial.rss < LARGE * now.rss:
                # A large effect makes the null in which it is to be seen: what it leaves is the better one.
                coloured = family_wise(score, chance.scores(trial).null)
            p_value = max(p_value, coloured)
            if p_value > chance.level:
                continue
        trial = fit(trial.recording, trial.setup, trial.terms, weights_from(trial), held=trial.held)
        return trial, p_value
    return None


def follows_the_clock(candidate: Candidate) -> bool:
    """True for steps and drifts, which errors that remember imitate."""
    where = candidate.place.where
    return candidate.place.scan or "from_row" in where or where.get("driver") == "time"


def improves(before: Fitted, after: Fitted) -> bool:
    """True where the rows left out are predicted better, in interleaved and in time-block folds together."""
    pose = before.recording.pose
    # Both are whitened alike, or they could not be compared.
    old = heldout_loss(before.jacobian, before.white, pose, before.ghosts)
    new = heldout_loss(after.jacobian, after.white, pose, after.ghosts)
    return new[0] < old[0] and new[0] + new[1] < old[0] + old[1]


def refined(now: Fitted) -> Fitted:
    """The last term's starting row put where it fits best; long recordings are scanned in stretches first."""
    length = -(-now.rows // SCAN_ROWS)
    index = len(now.terms) - 1
    term = now.terms[index]
    if length == 1 or "from_row" not in term.where:
        return now
    jacobian, white = without(now, index)
    base = basis(jacobian)
    rest = white - base.q @ (base.q.T @ white)
    open_place = replace(term.place, where=without_row(term.where))
    block = term.effect.columns(now.columns, open_place)
    order, row = now.recording.situation.order, int(term.where["from_row"])
    best, at = -1.0, row
    for start in order[(order > row - length) & (order < row + length)]:
        columns = (block * (order >= start)[:, None, None]).reshape(-1, block.shape[2])
        columns = np.concatenate([columns, np.zeros((len(white) - len(columns), columns.shape[1]))])
        own = basis(base.project(columns))
        gain = float(np.sum((own.q.T @ rest) ** 2))
        if gain > best:
            best, at = gain, int(start)
    moved = with_row(Candidate(term.effect, term.place), at).place
    terms = (*now.terms[:index], replace(term, place=moved))
    return fit(now.recording, now.setup, terms, now.weights, held=now.held)
