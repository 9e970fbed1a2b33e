"""One linear problem at a time, and what is in: the part of the work that does not decide."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from app.diagnosis.effects.effect import Level
from app.diagnosis.kinematic.levels import put_in_order
from app.diagnosis.kinematic.spread import memory_of
from app.diagnosis.models.kinematic.candidates import Library
from app.diagnosis.models.kinematic.library import Linear, likeness, linearised
from app.diagnosis.models.kinematic.state import State
from app.diagnosis.regression.evidence import Evidence, Posterior, Selection
from app.diagnosis.selection.change_points import Change
from app.diagnosis.selection.search import Offer, Search, open_among
from app.diagnosis.thresholds.evidence import STEP, TAKE, WIDTHS
from app.diagnosis.thresholds.naming import MEMBER_WALD

#: Levels that have names, and all.
NAMED = (Level.CALIBRATION, Level.MECHANISM)
ALL = tuple(Level)


class Problem:
    """A recording linearised at a state, with what is taken by label, so that it carries over to the next one.

    Attributes:
        library: all candidates.
        labels: what is in: number of a candidate or name of a family -> width.
        linear, evidence: of the present linearisation.
    """

    def __init__(self, library: Library):
        self.library = library
        self.labels: dict[object, float] = {}
        self._linear: Linear | None = None
        self._ended: tuple[State, set[object], set[Level]] | None = None
        self._levels: set[Level] = set()
        self._scanned: dict[tuple, list[tuple[float, Change]]] = {}
        self.evidence: Evidence

    @property
    def linear(self) -> Linear:
        assert self._linear is not None, "nothing is linearised yet"
        return self._linear

    def linearise(self, state: State, levels: tuple[Level, ...], marginal: bool, everywhere: bool) -> None:
        """At a state, with all candidates of these levels.

        Args:
            marginal: whether unnamed columns keep only what families leave.
            everywhere: whether the arm is taken to be off everywhere: zeros, lengths and angles then stay in, by about
                as many of their usual sizes. Each with a width of its own, a few rows in a part of the workspace would
                put all of it down to one kind and say nothing of other poses.
        """
        needed = {k for k in self.labels if isinstance(k, int)}
        if self._linear is not None and likeness(self._linear, state) is None:
            self._linear = None  # of many rows two at once are too much memory
            del self.evidence
        self._linear = linearised(state, self.library, levels, needed, self._linear)
        self._scanned, self._levels = {}, set(levels)
        if marginal:
            put_in_order(self.linear)
        self.evidence = Evidence(self.linear.design, self.linear.groups)
        self.linear.groups = self.evidence.groups  # changes found later join both
        if marginal:
            self.keep_families()
        elif everywhere:
            self.keep_families(Level.CALIBRATION)
        if everywhere:
            self.evidence.alike = {g for g in self.families() if self._built(g)}

    def searched(self, selection: Selection) -> None:
        """Remembers that a search of everything ended here."""
        self._ended = self.linear.born, {self.linear.groups[g].label for g in selection}, self._levels

    def stands(self) -> bool:
        """Whether a search would end where the last one did: the same columns, rows weighed alike, the same laws."""
        if self._ended is None:
            return False
        born, labels, levels = self._ended
        return born is self.linear.born and labels == set(self.labels) and levels.issuperset(self._levels)

    def selection(self) -> Selection:
        """What is in, by the numbers of the present groups."""
        return {
            g: self.labels[grp.label] for g, grp in enumerate(self.linear.groups) if grp.label in self.labels
        }

    def take(self, selection: Selection) -> None:
        self.labels = {self.linear.groups[g].label: v for g, v in selection.items()}

    def families(self) -> list[int]:
        return [g for g, group in enumerate(self.linear.groups) if isinstance(group.label, str)]

    def keep_families(self, most: Level = Level.UNKNOWN) -> None:
        """Families that every arm has stay in, however small their width, up to a level."""
        self.evidence.kept = {g for g in self.families() if self._always(g, most)}

    def by_label(self, posterior: Posterior) -> dict[int, tuple[np.ndarray, np.ndarray]]:
        """Weights and covariance of every candidate that is in, by its number."""
        inside = set(posterior.columns.tolist())
        return {
            number: posterior.of(columns)
            for number, columns in self.linear.columns.items()
            if len(columns) and inside.issuperset(columns.tolist())
        }

    def set_members_free(self) -> None:
        """Members that stand out of their families get a width of their own: the family's would draw them to zero."""
        selection = self.selection()
        posterior = self.evidence.posterior(selection)
        inside = {i for g in selection if g in set(self.families()) for i in self.linear.members[g]}
        for number in inside - set(self.labels):
            columns = self.linear.columns[number]
            weights, covariance = posterior.of(columns)
            if float(weights @ np.linalg.solve(covariance, weights)) > MEMBER_WALD:
                variance = max(float(np.mean(weights**2)) / posterior.variance, float(WIDTHS[0]))
                self.labels[number] = float(WIDTHS[np.searchsorted(WIDTHS, min(variance, float(WIDTHS[-1])))])

    def calibrated(self) -> bool:
        """Whether a family is in that an ordinary calibration fits."""
        return any(self.calibrates(g) for g in set(self.selection()) & set(self.families()))

    def calibrates(self, family: int) -> bool:
        """Whether a group is one of those that an ordinary calibration fits."""
        return self._always(family, Level.CALIBRATION)

    def _built(self, family: int) -> bool:
        return all(self.library.fixed[i].effect.built for i in self.linear.members[family])

    def _always(self, family: int, most: Level) -> bool:
        effects = [self.library.fixed[i].effect for i in self.linear.members[family]]
        return all(e.always and e.level <= most for e in effects)

    def laws(self, unknown: bool) -> list[int]:
        return [
            g
            for g, group in enumerate(self.linear.groups)
            if isinstance(group.label, int)
            and (unknown or self.library.fixed[group.label].effect.level in NAMED)
            and not self.library.fixed[group.label].effect.serving
            and not self.library.fixed[group.label].place.scan  # changes come by the scan alone
        ]

    def scan(self, selection: Selection) -> Iterable[Offer]:
        """Changes at rows; what a session's own set-up takes of them is taken off already."""
        linear = self.linear
        if not self.library.scanned:
            return
        order = self.library.situation.order
        # no two changes start together: what takes several rows to come about would be several of them
        taken = [
            (index, int(np.searchsorted(order, self.library.fixed[number].place.where["from_row"])))
            for g in selection
            if isinstance(number := linear.groups[g].label, int) and self.library.fixed[number].place.scan
            for index in range(len(self.library.scanned))
        ]
        key = tuple(sorted(selection.items()))
        if key not in self._scanned:  # a selection is left and come back to many times
            fresh, penalty = self._fresh(selection), STEP + np.log(len(order))
            # errors that remember the row before are worth fewer rows, and make steps by themselves
            self._scanned[key] = [
                ((change.gain + penalty) * fresh - penalty, change)
                for change in linear.scanner.best(self.evidence, selection, taken, TAKE)
            ]
        for gain, change in self._scanned[key]:
            yield Offer(gain, change.gamma, lambda c=change: self._changed(c))

    def _fresh(self, selection: Selection) -> float:
        """By how much errors that hang together lower the evidence of a step; 1 where they do not.

        With r the correlation of errors with the row before, a row is worth (1 - r) / (1 + r) rows. The root of it is
        taken, because part of what hangs together is the very change that is looked for.
        """
        memory = memory_of(self.left(selection) * (self.linear.state.weights > 0))
        return float(np.sqrt((1.0 - memory) / (1.0 + memory)))

    def _changed(self, change: Change) -> int:
        scanned = self.library.scanned[int(change.kind.label)]  # type: ignore[call-overload]
        row = int(self.library.situation.order[change.row])
        number = self.library.number_of(self.library.at_row(scanned, row))
        for g, group in enumerate(self.linear.groups):
            if group.label == number and isinstance(group.label, int):
                return g
        return self.linear.add(number)

    def search(self, allowed: list[int]) -> Search:
        return Search(self.evidence, open_among(self.evidence, allowed), self.scan)

    def left(self, selection: Selection) -> np.ndarray:
        """(m, k) residual [m, rad] that the linear model leaves."""
        posterior = self.evidence.posterior(selection)
        design = self.linear.design
        rest = design.left(posterior.columns, posterior.weights)
        weights = self.linear.state.weights
        return np.where(weights > 0, rest.reshape(weights.shape) / np.where(weights > 0, weights, 1.0), 0.0)

    def values(self, selection: Selection) -> dict[int, np.ndarray]:
        """Weights [nominal sizes] of every candidate that is in, as the exact model takes them."""
        posterior = self.evidence.posterior(selection)
        full = self.linear.design.expanded(posterior.columns, posterior.weights)
        inside: dict[int, np.ndarray] = {}
        for number, columns in self.linear.columns.items():
            if len(columns) and np.any(full[columns]):
                inside[number] = full[columns]
        return inside
