"""Forward selection with a family-wise null, held-out falls, exchange and backward elimination."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.diagnosis.motion.bending import bent
from app.diagnosis.motion.heldout import heldout_losses
from app.diagnosis.motion.locate import located
from app.diagnosis.motion.scoring import Board, Candidate, Solution, null_scores, score_all, solve
from app.diagnosis.motion.system import Group, System
from app.diagnosis.result import Progress

FLIPS = 199
LEVEL = 0.01
MOST_TERMS = 40
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
    """

    system: System
    prior: np.ndarray
    groups: list[Group]
    windows: dict[Group, np.ndarray]
    seed: int = 0
    change: bool = False

    def __post_init__(self):
        rng = np.random.default_rng(self.seed)
        self.signs = rng.choice([-1.0, 1.0], (FLIPS, self.system.block_count + 1))
        self.signs[:, -1] = 0.0  # the prior's block is no data: flipped, a real load would hide behind it

    def board(self, solution: Solution, selected: list[Group]) -> Board:
        """Scores of everything that may still come in."""
        taken = {_key(g) for g in selected}
        groups = [g for g in self.groups if not g.base and _key(g) not in taken]
        return score_all(self.system, solution, groups, self.windows, list(self.windows))

    def forward(self, progress: Progress, start: list[Term]) -> list[Term]:
        """Takes the best candidate as long as it beats the null and held-out loss falls.

        Args:
            start: terms that are in already and stay.
        """
        terms = list(start)
        refused: set = set()
        while len(terms) < MOST_TERMS:
            selected = [t.group for t in terms]
            progress(0.35 + 0.4 * len(terms) / (len(terms) + 8), f"search, {len(terms)} found")
            solution = solve(self.system, selected, self.prior)
            board = self.board(solution, selected)
            if not board.candidates:
                break
            null = null_scores(board, self.signs)
            bar = max(float(null.max()), np.log10(len(board.candidates) / LEVEL))
            loss, taken = None, False
            for index in np.argsort(-board.score)[:12]:
                candidate = board.candidates[index]
                if board.score[index] <= bar:
                    break
                if (_key(candidate.group), candidate.window) in refused:
                    continue
                group = self._settle(candidate, selected)
                if loss is None:
                    loss = heldout_losses(self.system, selected, self.prior)
                falls = heldout_losses(self.system, [*selected, group], self.prior) < loss
                if falls.all() or (group.law is not None and group.law.windowed and falls[0]):
                    taken = True
                    p = (1 + np.sum(null >= board.score[index])) / (1 + len(null))
                    terms.append(Term(group, float(p), candidate.visible))
                    break
                refused.add((_key(candidate.group), candidate.window))
            if not taken:
                break
            terms = self.backward(terms, len(start))
        return terms

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
            gains = self.losses_without([t.group for t in terms])[keep:]
            spare = gains - np.log(max(self.system.rows, 3)) * sizes
            weakest = int(np.argmin(spare))
            if spare[weakest] > DROP:
                return terms
            terms = [t for i, t in enumerate(terms) if i != weakest + keep]
        return terms

    def losses_without(self, selected: list[Group]) -> np.ndarray:
        """(s,) how much the whitened sum of squares rises when each is taken out and the rest refitted."""
        solution = solve(self.system, selected, self.prior)
        out: list[float] = []
        at = len(solution.theta) - sum(g.size for g in selected)
        for group in selected:
            place = slice(at, at + group.size)
            part = solution.theta[place]
            out.append(float(part @ np.linalg.solve(solution.covariance[place, place], part)))
            at += group.size
        return np.array(out)


def _key(group: Group) -> tuple:
    """A law at a place counts once, whatever its shape."""
    ripple = group.law is not None and group.law.key == "torque_ripple"
    shape = tuple(sorted(group.shape.items())) if ripple else ()
    return (group.label, tuple(sorted((k, str(v)) for k, v in group.where.items())), shape)
