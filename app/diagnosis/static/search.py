"""Which effects earn their place: taken one by one, each against chance and against rows left out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from app.diagnosis.static.fit import Fitted, Term, fit
from app.diagnosis.static.heldout import heldout_loss
from app.diagnosis.static.library import Candidate, Library, library
from app.diagnosis.static.noise import weights_from
from app.diagnosis.static.scan import SCAN_ROWS, with_row
from app.diagnosis.static.score import Basis, Scores, basis, family_wise, flips, score_library, significance
from app.diagnosis.static.serial import coloured_score, stretch, stretch_flips

#: A term is taken only where chance would do as well in at most this share of searches.
LEVEL = 0.01
MOST_TERMS = 6
NULLS = 199
#: Share of an effect's signature that base, tool and the rest must leave for it to be named.
LEAST_VISIBLE = 0.05
_TRIES = 8  # candidates looked at before a round is given up
_ALIKE = 0.05  # difference of -log10 p below which two candidates count as exactly alike
_BETTER = 0.5  # difference of -log10 p that makes a swap worth a fit


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


def new_term(candidate: Candidate, fitted: Fitted) -> Term:
    """The candidate as a term that starts from nothing."""
    count = len(candidate.effect.quantities(fitted.recording.situation, candidate.place))
    return Term(candidate.effect, candidate.place, np.zeros(count))


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
    signs = flips(rng, with_ghosts(start.recording.pose, start.ghosts), nulls)
    for count in range(MOST_TERMS):
        tick(count / MOST_TERMS, "looking for what is missing")
        base = basis(now.jacobian)
        scores = score_all(now, library(now.columns, wanted, now.ghosts), base, signs)
        null = scores.null
        taken = _take(now, scores, level, lambda trial: serial_null(trial, wanted, rng, nulls))
        if taken is None:
            break
        now, p_value = taken
        p_values.append(p_value)
        now = settle(refined(now), wanted)
    return Found(now, tuple(p_values), null)


def serial_null(
    trial: Fitted, wanted: tuple[Candidate, ...], rng: np.random.Generator, nulls: int
) -> np.ndarray | None:
    """The null where errors come in stretches of time, from what the trial leaves; None where they do not."""
    length = stretch(trial)
    if length == 1:
        return None
    signs = stretch_flips(rng, with_ghosts(trial.recording.pose, trial.ghosts), nulls, length)
    base = basis(trial.jacobian)
    return score_all(trial, library(trial.columns, wanted, trial.ghosts), base, signs).null


def _take(
    now: Fitted, scores: Scores, level: float, in_stretches: Callable[[Fitted], np.ndarray | None]
) -> tuple[Fitted, float] | None:
    """The fit with the best candidate that stands, or None.

    Args:
        in_stretches: gives the null of serially correlated errors for a trial, or None.
    """
    present = {key_of(term.effect.key, term.where) for term in now.terms}
    order = scores.order()
    for index in _by_rank(order, scores)[:_TRIES]:
        p_value = scores.p_value(index)
        if not p_value <= level:
            return None
        candidate = scores.candidates[index]
        if (
            scores.visible[index] < LEAST_VISIBLE
            or key_of(candidate.effect.key, candidate.place.where) in present
        ):
            continue
        trial = fit(
            now.recording, now.setup, (*now.terms, new_term(candidate, now)), now.weights, held=now.held
        )
        if at_bound(trial, len(trial.terms) - 1) or not improves(now, trial):
            continue
        null = in_stretches(trial)
        if null is not None:
            p_value = max(p_value, family_wise(scores.score[index], null))
            if p_value > level:
                return None
        if follows_the_clock(candidate):
            p_value = max(p_value, family_wise(coloured_score(trial, len(trial.terms) - 1), scores.null))
            if p_value > level:
                continue
        trial = fit(trial.recording, trial.setup, trial.terms, weights_from(trial), held=trial.held)
        return trial, p_value
    return None


def follows_the_clock(candidate: Candidate) -> bool:
    """True for steps and drifts, which errors that remember imitate."""
    where = candidate.place.where
    return candidate.place.scan or "from_row" in where or where.get("driver") == "time"


def with_ghosts(pose: np.ndarray, ghosts: int) -> np.ndarray:
    """Numbers of the poses, every ghost row one of its own."""
    return np.concatenate([pose, pose.max() + 1 + np.arange(ghosts)])


def key_of(key: str, where) -> tuple:
    """Identity of a finding for "is it in already": steps of one kind may recur at another row."""
    return (key, *sorted((k, v) for k, v in where.items()))


def _by_rank(order: np.ndarray, scores: Scores) -> list[int]:
    """By score; among candidates that explain exactly alike, the one a person would name first."""
    best: list[int] = []
    left = list(order[:30])
    while left:
        top = scores.score[left[0]]
        alike = [i for i in left if top - scores.score[i] < _ALIKE and top > 0]
        alike = alike or left[:1]
        alike.sort(key=lambda i: (scores.candidates[i].effect.rank, -scores.score[i]))
        best += alike
        left = [i for i in left if i not in alike]
    return best


def at_bound(fitted: Fitted, index: int) -> bool:
    """True where a fitted value sits on a physical bound, which means the effect has the wrong sign."""
    term = fitted.terms[index]
    quantities = term.effect.quantities(fitted.recording.situation, term.place)
    return any(v <= q.lower or v >= q.upper for v, q in zip(term.values, quantities, strict=True))


def improves(before: Fitted, after: Fitted) -> bool:
    """True where the rows left out are predicted better, in interleaved and in time-block folds together."""
    pose = before.recording.pose
    # Both are whitened alike, or they could not be compared.
    old = heldout_loss(before.jacobian, before.white, pose, before.ghosts)
    new = heldout_loss(after.jacobian, after.white, pose, after.ghosts)
    return new[0] < old[0] and new[0] + new[1] < old[0] + old[1]


def without(fitted: Fitted, index: int) -> tuple[np.ndarray, np.ndarray]:
    """Jacobian without term `index`, and the residual with its share put back."""
    where = fitted.slices[index]
    keep = np.ones(fitted.jacobian.shape[1], bool)
    keep[where] = False
    white = fitted.white + fitted.jacobian[:, where] @ fitted.terms[index].values
    return fitted.jacobian[:, keep], white


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
        if scores.score[at] < mine + margin:
            return None
        terms = list(now.terms)
        terms[index] = new_term(candidate, now)
        trial = fit(now.recording, now.setup, tuple(terms), now.weights, held=now.held)
        if not at_bound(trial, index) and trial.bic < now.bic - 1e-6:
            return trial
    return None


def _same_but_row(candidate: Candidate, term: Term) -> bool:
    def bare(where):
        return {k: v for k, v in where.items() if k != "from_row"}

    return candidate.effect is term.effect and bare(candidate.place.where) == bare(term.where)


def _own_score(now: Fitted, index: int, base: Basis, white: np.ndarray) -> float:
    """-log10 p of the term that sits there now, by the same measure as its rivals."""
    block = base.project(now.jacobian[:, now.slices[index]])
    rest = white - base.q @ (base.q.T @ white)
    own = basis(block)
    gain = float(np.sum((own.q.T @ rest) ** 2))
    dof = max(now.size - base.q.shape[1], 2)
    return float(significance(np.array(gain), float(rest @ rest), block.shape[1], dof))


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
    open_place = replace(term.place, where={k: v for k, v in term.where.items() if k != "from_row"})
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
