"""Forward selection with a family-wise null, held-out falls, exchange and backward elimination."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType

import numpy as np

from app.diagnosis.motion.bending import bent
from app.diagnosis.motion.heldout import heldout_losses
from app.diagnosis.motion.locate import located
from app.diagnosis.motion.scoring import (
    Board,
    Candidate,
    Solution,
    minus_log_p,
    null_scores,
    score_all,
    solve,
)
from app.diagnosis.motion.system import Group, System
from app.diagnosis.result import Progress

FLIPS = 199
LEVEL = 0.01
MOST_TERMS = 40
MOST_EVENTS = {"payload_change": 2, "contact": 3}
LOUD = 0.02  # share of what is left that a law must explain to come in past a wild null
EVENT = 1.8  # times the null an event's score must be
EVENTS_TRIED = 3  # in one round: their windows overlap, the next is hardly another
TRIES = 12  # candidates looked at closely in one round
DROP = 8.0  # a term must be worth this much beyond the Bayesian criterion


@dataclass(frozen=True, eq=False)
class Term:
    """A group that was taken in, with the family-wise p it came in by."""

    group: Group
    p_value: float
    visible: float


@dataclass(eq=False)
class Search:
    """One log's selection.

    Args:
        prior: information on the leading (nuisance) unknowns.
        change: True where only changes against a reference are sought: signs are then free.
        known: number of leading terms that are the reference's own.
    """

    system: System
    prior: np.ndarray
    groups: list[Group]
    windows: dict[Group, np.ndarray]
    seed: int = 0
    change: bool = False
    known: int = 0

    def __post_init__(self):
        rng = np.random.default_rng(self.seed)
        self.signs = rng.choice([-1.0, 1.0], (FLIPS, self.system.block_count + 1))
        self.signs[:, -1] = 0.0  # the prior's block is no data: flipped, a real load would hide behind it

    def board(self, solution: Solution, selected: list[Group], *, null: bool = True) -> Board:
        """Scores of everything that may still come in."""
        taken = {g.key for g in selected[self.known :]}
        groups = [g for g in self.groups if not g.base and g.key not in taken]
        count = Counter(g.label for g in selected)
        bases = [
            g for g in self.windows if count[g.label] < MOST_EVENTS.get(g.label, 1) and len(self.windows[g])
        ]
        return score_all(self.system, solution, groups, self.windows, bases, null=null)

    def forward(self, progress: Progress, start: list[Term], stay: int = 0) -> list[Term]:
        """Takes the best candidate as long as it beats the null and held-out loss falls.

        Args:
            start: terms that are in already; the first `stay` of them stay.
        """
        terms = list(start)
        refused: set = set()
        for _ in range(MOST_TERMS):
            if len(terms) >= MOST_TERMS:
                break
            progress(0.35 + 0.4 * len(terms) / (len(terms) + 8), f"search, {len(terms)} found")
            more = self._best(terms, refused)
            if not more:
                break
            kept = self.backward([*terms, *more], stay)
            if len(kept) <= len(terms) and all(t in terms for t in kept):
                break  # what came in went out again
            terms = kept
        return terms

    def _best(self, terms: list[Term], refused: set) -> list[Term]:
        """The best candidate, and with it the best laws of other joints that stand as well with it in.

        Args:
            refused: what was tried and earned no place; grows.
        """
        selected = [t.group for t in terms]
        solution = solve(self.system, selected, self.prior)
        board = self.board(solution, selected)
        if not len(board):
            return []
        sure = np.log10(len(board) / LEVEL)
        bar = _Bar(board, self.signs, sure)
        rss, loss, tries, events = solution.rss, None, 0, 0
        more: list[Term] = []
        touched: set[int] = set()
        for index in np.argsort(-board.score):
            score, gain, candidate = board.score[index], board.gain[index], board[index]
            group = candidate.group
            windowed = group.law is not None and group.law.windowed
            if tries == TRIES or score <= sure:
                break
            # While much is left unexplained the null is as wild as the residual: then what was not
            # used for the fit must speak, and speak loudly.
            loud = gain >= LOUD * rss
            if not loud and not windowed and score <= bar.value:
                break
            if windowed and (more or events == EVENTS_TRIED):
                continue
            if more and (group.joint is None or group.joint in touched):
                if group.joint is None:
                    break
                continue
            if (key_of(group), candidate.window) in refused:
                continue
            tries += 1
            group = self._settle(candidate, selected)
            if not self.possible(group, selected) or (windowed and not self._stands_out(group, selected)):
                events += windowed
                self._refuse(group, candidate, refused)
                continue
            if loss is None:
                loss = heldout_losses(self.system, selected, self.prior)
            falls = heldout_losses(self.system, [*selected, group], self.prior)
            good = falls < (1.0 - LOUD) * loss
            if not good.all() and score > bar.value:
                good = falls < loss
            if not (good.all() or (windowed and good[0])):
                # Beside others that came in just now it may only have been too late.
                self._refuse(group, candidate, set() if more else refused)
                continue
            more.append(Term(group, 1.0 / (1 + FLIPS), candidate.visible))
            if group.joint is None:
                break
            touched.add(group.joint)
            selected, loss = [*selected, group], falls
        return more

    def _refuse(self, group: Group, candidate: Candidate, refused: set) -> None:
        refused.add((key_of(candidate.group), candidate.window))
        if group is not candidate.group:
            self.system.remove(group)

    def possible(self, group: Group, selected: list[Group]) -> bool:
        """True where the values it would take are some that an arm can have."""
        if self.change or group.law is None:
            return True
        theta = solve(self.system, [*selected, group], self.prior).theta[-group.size :]
        return group.law.lawful(group.law.values(theta[: len(group.law.linear)], group.shape))

    def _stands_out(self, event: Group, selected: list[Group]) -> bool:
        """True where an event is far above the null of what it leaves.

        It fills a few blocks, whose signs a flip leaves alike often enough: with the event still in it the null
        is as high as the event itself.
        """
        with_it = [*selected, event]
        gain, size = self.losses_without(with_it)[-1], event.size
        solution = solve(self.system, with_it, self.prior)
        null = null_scores(self.board(solution, with_it), self.signs)
        # Events are sought at very many places: noise that remembers finds one easily.
        return float(minus_log_p(np.array([gain]), np.array([size]))[0]) > EVENT * float(null.max())

    def _settle(self, candidate: Candidate, selected: list[Group]) -> Group:
        """The candidate with its window or its shape moved to where the fit is best."""
        law = candidate.group.law
        assert law is not None
        if candidate.window is not None:
            return located(self.system, self.prior, selected, candidate, law.key == "contact")
        return bent(self.system, self.prior, selected, candidate.group)

    def backward(self, terms: list[Term], keep: int = 0) -> list[Term]:
        """Drops terms whose place others have taken; the first `keep` stay."""
        while len(terms) > max(keep, 1):
            sizes = np.array([t.group.size for t in terms[keep:]])
            beyond = np.array([dear(t.group, [o.group for o in terms]) for t in terms[keep:]])
            gains = self.losses_without([t.group for t in terms])[keep:]
            spare = gains - np.log(max(self.system.rows, 3)) * sizes - beyond
            weakest = int(np.argmin(spare))
            if spare[weakest] > 0.0:
                return terms
            terms = [t for i, t in enumerate(terms) if i != weakest + keep]
        return terms

    def losses_without(
        self, selected: list[Group], done: Mapping[int, np.ndarray] = MappingProxyType({})
    ) -> np.ndarray:
        """(s,) how much the whitened sum of squares rises when each is taken out and the rest refitted.

        Args:
            done: group -> what the samples were corrected by already, in its columns.
        """
        solution = solve(self.system, selected, self.prior)
        out: list[float] = []
        at = len(solution.theta) - sum(g.size for g in selected)
        for i, group in enumerate(selected):
            place = slice(at, at + group.size)
            part = solution.theta[place] + done.get(i, 0.0)
            spread = solution.covariance[place, place]
            gain = part @ np.linalg.solve(spread, part) if group.size > 1 else part[0] ** 2 / spread[0, 0]
            out.append(float(gain))
            at += group.size
        return np.array(out)


class _Bar:
    """What a score must exceed; the null is drawn only where it is asked for."""

    def __init__(self, board: Board, signs: np.ndarray, sure: float):
        self._board, self._signs, self._sure = board, signs, sure

    @cached_property
    def value(self) -> float:
        return max(float(null_scores(self._board, self._signs).max()), self._sure)


def resists(group: Group) -> bool:
    """True for the laws of a joint that hold it back by its own speed, warm or cold."""
    return group.law is not None and group.law.resists


def is_common(group: Group) -> bool:
    """True for what nearly every joint has."""
    return group.law is not None and group.law.common


def dear(group: Group, beside: Sequence[Group]) -> float:
    """What a term must be worth beyond the Bayesian criterion.

    Dry or viscous friction beside another friction law of its joint is worth nothing more: it is there, and
    left out it would be made up for by the other's values.
    """
    if is_common(group) and any(resists(g) and not is_common(g) and g.joint == group.joint for g in beside):
        return 0.0
    return DROP


def key_of(group: Group) -> tuple:
    """A law at a place counts once, whatever its shape."""
    return group.key
