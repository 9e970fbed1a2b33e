"""Which groups describe the data best: adds the best, drops what falls behind, exchanges, until nothing improves."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Protocol

import numpy as np

from app.diagnosis.regression.groups import Selection
from app.diagnosis.thresholds.evidence import BETTER, DROP, EXCHANGES, PAIR_COSINE, TAKE

if TYPE_CHECKING:
    from app.diagnosis.regression.evidence import Evidence
    from app.diagnosis.regression.instead import Instead


@dataclass(frozen=True)
class Offer:
    """A group that is only built when it is taken: a change in time that was found by scanning the recording.

    Args:
        gain: nats it would add, penalty included.
        gamma: its best width.
        build: makes the group and returns its number.
        changes: False for a group that is there already.
    """

    gain: float
    gamma: float
    build: Callable[[], int]
    changes: bool = True


class Opens(Protocol):
    """Groups that may be taken beside a selection, of all or of some."""

    def __call__(self, selection: Selection, among: Sequence[int] | None = None, /) -> Sequence[int]: ...


#: Best offers (one a kind) given a selection.
Scan = Callable[[Selection], Iterable[Offer]]
#: Groups of a selection that another of its groups needs.
Bound = Callable[[Selection], Collection[int]]


def open_among(evidence: Evidence, allowed: Sequence[int]) -> Opens:
    """Those of some groups that are not in and not excluded by one that is."""

    every = frozenset(allowed)

    def opens(selection: Selection, among: Sequence[int] | None = None) -> list[int]:
        groups = evidence.groups
        taken = {groups[g].exclusive for g in selection} - {""}
        asked = allowed if among is None else [g for g in among if g in every]
        return [g for g in asked if g not in selection and groups[g].exclusive not in taken]

    return opens


def _offered(allowed: Sequence[int], gains: np.ndarray, gammas: np.ndarray) -> Offer:
    """The best of some groups."""
    k = int(gains.argmax())
    return Offer(float(gains[k]), float(gammas[k]), lambda: allowed[k], False)


@dataclass(eq=False)
class Search:
    """Climbs in evidence from a selection.

    Args:
        evidence: holds the groups.
        opens: what may be taken.
        scan: offers changes in time; None where there are none.
        bound: what cannot be dropped.
        take, drop: nats beyond its penalty that a group must bring to be taken, and below which it falls again.
        eager: True where exchanges are tried after every step, with changes in time among them; False where that would
            take too long (hundreds of laws): then they wait until nothing more can be taken.
        dear: nats that the best group must bring for a scan that takes long to wait, or for every fourth step.
        replaces: True where a group that enters takes the place of those that have columns of it.
    """

    evidence: Evidence
    opens: Opens
    scan: Scan | None = None
    bound: Bound = lambda selection: ()
    take: float = TAKE
    drop: float = DROP
    eager: bool = True
    dear: float = np.inf
    replaces: bool = False

    def climb(self, start: Selection, *, most: int = 40, swaps: bool = True) -> Selection:
        """The best selection reached from `start`.

        Args:
            most: additions in a row at most.
            swaps: whether a group may be exchanged for another.
        """
        now = self.tuned(start)
        for _ in range(EXCHANGES):
            now = self.grown(now, most, swaps and self.eager)
            better = self.exchanged(now) if swaps and not self.eager else now
            if better == now:
                break
            now = better
        return now

    def grown(self, start: Selection, most: int, swaps: bool) -> Selection:
        """Takes the best group again and again, as long as the evidence rises once all widths are learnt anew."""
        now, score, plain = start, self.evidence.score(start), replace(self, scan=None)
        search = self
        for step in range(most):
            best = search._best(now, step)
            if best is None or best.gain < self.take:
                break
            trial = self.pruned(self.tuned(self._with(now, best)))
            trial = self.exchanged(trial) if swaps else trial
            reached = self.evidence.score(trial)
            if reached > score + BETTER:
                now, score, search = trial, reached, self
            elif best.changes and search is not plain:
                search = plain  # what was promised in time does not hold: something lasting may
            else:
                break
        return now

    def tuned(self, selection: Selection, sweeps: int = 2) -> Selection:
        """Every width at its best; a group without a width falls out, unless it is bound."""
        return self.evidence.tuned(selection, sweeps, self.bound(selection))

    def _best(self, selection: Selection, step: int = 0) -> Offer | None:
        """The best group that could be added."""
        allowed = self.opens(selection)
        best = _offered(allowed, *self.evidence.gains(selection, allowed)) if allowed else None
        waits = best is not None and best.gain >= self.dear and step % 4 != 0
        return best if self.scan is None or waits else self._scanned(selection, best)

    def _scanned(self, selection: Selection, best: Offer | None) -> Offer | None:
        """The best of what is there and of what a scan offers."""
        assert self.scan is not None
        for offer in self.scan(selection):
            if best is None or offer.gain > max(best.gain, self.take):
                best = offer
        return best

    def _with(self, selection: Selection, offer: Offer) -> Selection:
        """A selection with an offer in it."""
        group, rest = offer.build(), selection
        if self.replaces:
            own, groups = set(self.evidence.groups[group].columns.tolist()), self.evidence.groups
            rest = {g: v for g, v in selection.items() if not own & set(groups[g].columns.tolist())}
        return {**rest, group: offer.gamma}

    def pruned(self, selection: Selection) -> Selection:
        """Drops, the least worthy first, what no longer earns its place."""
        now = dict(selection)
        while now:
            fixed = self.evidence.kept | set(self.bound(now))
            losses = [(v, g) for g, v in self.evidence.losses(now).items() if g not in fixed]
            if not losses or min(losses)[0] >= self.drop:
                break
            del now[min(losses)[1]]
            now = self.tuned(now, 1)
        return now

    def exchanged(self, selection: Selection) -> Selection:
        """Changes one group for another where that is better, the best exchange first."""
        now = selection
        for _ in range(EXCHANGES - 1):
            losses, bound = self.evidence.losses(now), self.evidence.kept.union(self.bound(now))
            best_gain, best = 2.0 * BETTER, None
            if not now:
                break
            instead = self.evidence.instead(now)
            for g in now:
                if g in bound:
                    continue
                rest = {k: v for k, v in now.items() if k != g}
                other = self._best_instead(rest, g, instead, losses[g] + best_gain)
                if other is not None and other.gain - losses[g] > best_gain:
                    best_gain, best = other.gain - losses[g], (rest, other)
            if best is None:
                break
            now = self.pruned(self.tuned(self._with(*best)))
        return now

    def _best_instead(self, rest: Selection, g: int, instead: Instead, least: float) -> Offer | None:
        """The best group beside `rest` that is not `g`, among those that may bring more than `least` nats."""
        may, best = sorted(instead.may(g, least) - {g}), None
        allowed = self.opens(rest, may) if may else ()
        if allowed:
            best = _offered(allowed, *instead.gains(g, allowed))
        return self._scanned(rest, best) if self.eager and self.scan is not None else best

    def paired(self, selection: Selection) -> Selection:
        """Two groups at once where either alone earns nothing: one hides while the other is still in the residual.

        Only columns that point alike can hide each other; all such pairs of small groups are tried, each with one
        common width.
        """
        pairs = self._alike([g for g in self.opens(selection) if len(self.evidence.groups[g].columns) <= 2])
        if not pairs:
            return selection
        gains, gammas = self.evidence.joint_gains(selection, pairs)
        best = int(gains.argmax())
        if gains[best] < self.take:
            return selection
        trial = {**selection, **dict.fromkeys(pairs[best], float(gammas[best]))}
        trial = self.pruned(self.tuned(trial))
        return trial if self.evidence.score(trial) > self.evidence.score(selection) + BETTER else selection

    def _alike(self, small: list[int]) -> list[tuple[int, int]]:
        """Pairs of groups with columns whose cosine is beyond PAIR_COSINE."""
        if len(small) < 2:
            return []
        groups, matrix = self.evidence.groups, self.evidence.statistics.matrix
        columns = np.concatenate([groups[g].columns for g in small])
        owner = np.concatenate([np.full(len(groups[g].columns), i) for i, g in enumerate(small)])
        norm = np.sqrt(np.maximum(matrix[columns, columns], 1e-300))
        cosine = np.abs(matrix[np.ix_(columns, columns)]) / norm[:, None] / norm
        first, second = np.nonzero(np.triu(cosine > PAIR_COSINE, 1))
        pairs = {(int(owner[a]), int(owner[b])) for a, b in zip(first, second, strict=True)}
        return [
            (small[a], small[b]) for a, b in sorted(pairs) if a != b and not self._exclude(small[a], small[b])
        ]

    def _exclude(self, a: int, b: int) -> bool:
        groups = self.evidence.groups
        shared = set(groups[a].columns.tolist()) & set(groups[b].columns.tolist())
        return bool(shared) or (groups[a].exclusive == groups[b].exclusive != "")
