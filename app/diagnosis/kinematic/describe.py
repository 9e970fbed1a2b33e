"""A recording described: few laws on a sound description, or families of a real arm, whichever the evidence prefers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from app.diagnosis.effects.effect import Level
from app.diagnosis.kinematic.description import Description
from app.diagnosis.kinematic.moved_base import with_moved_base
from app.diagnosis.kinematic.plain import plain_state
from app.diagnosis.kinematic.problem import ALL, NAMED, Problem
from app.diagnosis.kinematic.spread import as_errors_are
from app.diagnosis.models.kinematic.candidates import library_of
from app.diagnosis.models.kinematic.library import terms_from
from app.diagnosis.models.kinematic.rows import (
    even_weights,
    robust_squares,
    row_weights,
    t_likelihood,
    weighted_anew,
)
from app.diagnosis.models.kinematic.state import State, settled, state_of
from app.diagnosis.models.kinematic.terms import Term
from app.diagnosis.observations.pose_data import StaticRecording
from app.diagnosis.regression.evidence import Selection
from app.diagnosis.thresholds.evidence import (
    BETTER,
    COMPONENTS_A_PARAMETER,
    FAR_BEHIND,
    TAKE,
    WIDTHS,
)
from app.diagnosis.thresholds.rows import OUTLIER_WEIGHT, STEP_EDGE

Tick = Callable[[float, str], None]

#: Rounds in which rows are weighted anew and the search goes on at the exact model.
_ROUNDS = 3
#: Gauss-Newton steps of the last refit, and the share of the sum of squares below which a step is none.
_REFITS, _STILL = 4, 1e-5
#: A step whose robust sum of squares grows beyond this factor has left the range of the linear columns.
_LEFT = 1.3


def describe(recording: StaticRecording, held: tuple[Term, ...], tick: Tick) -> Description:
    """The whole order of work on one recording.

    Args:
        held: effects known already; they stay as they are.
    """
    plain, rows = plain_state(recording, held)
    work = _Work(Problem(library_of(recording.situation)), plain, rows)
    work.begin()
    for number in range(_ROUNDS):
        tick(0.2 + 0.2 * number, "searching")
        work.round(number)
    tick(0.8, "fitting everything found")
    return work.concluded()


class _Work:
    """The rounds of one description."""

    def __init__(self, problem: Problem, plain: State, rows: np.ndarray):
        self.problem, self.plain = problem, plain
        self.first, self.rows = with_moved_base(plain, rows, problem.library)  # where the search starts
        self.given: dict[object, float] = {
            problem.library.labels[t.label]: float(WIDTHS[-1]) for t in self.first.terms
        }
        self.state, problem.labels = self.first, dict(self.given)
        self.dense = False
        families = [
            c for c in problem.library.fixed if c.effect.whole and c.place.member and not c.effect.serving
        ]
        self.core = sum(len(c.widths) for c in families if c.effect.level == Level.CALIBRATION)
        parameters = sum(len(c.widths) for c in families)
        self.large = int(plain.recording.present.sum()) > COMPONENTS_A_PARAMETER * parameters

    def linearise(self, levels) -> None:
        self.problem.linearise(self.state, levels, self.dense and self.large, self.dense)

    def begin(self) -> None:
        """Few laws or families, with every row counting alike or by robust weights: by evidence.

        Rows after a change look like outliers until the change is in the model; rows that are wrong look like
        structure until they are set aside. Where the two differ both are tried.
        """
        first = self.first
        robust, self.rows = self._robust_start()
        self.state = replace(first, weights=robust)
        aside = int(np.count_nonzero(self.rows <= OUTLIER_WEIGHT))
        if aside < (STEP_EDGE if self.large else 1):  # fewer than any change in time has
            self.choose()
            return
        even = even_weights(first.recording, first.residual, 0.0)
        tried = [self._tried(robust), self._tried(even)]
        _, self.dense, self.problem.labels, weights = max(tried, key=lambda t: t[0])
        self.state = replace(first, weights=weights)

    def _robust_start(self) -> tuple[np.ndarray, np.ndarray]:
        """Weights by what families leave, where there are rows enough for them, else by what the set-up leaves."""
        if not self.large:
            return self.first.weights, self.rows
        self.linearise(NAMED)
        problem = self.problem
        start = {**dict.fromkeys(problem.families(), 1.0), **problem.selection()}
        selection = problem.evidence.tuned(start, 1)
        used = problem.linear.design.free_count + self.core
        return row_weights(self.plain.recording, problem.left(selection), used)

    def _tried(self, weights: np.ndarray) -> tuple[float, bool, dict, np.ndarray]:
        """A start from these weights: its merit on all rows, and what was taken."""
        self.state = replace(self.first, weights=weights)
        self.choose()
        problem = self.problem
        selection = problem.selection()
        factor = problem.evidence.factor(selection)
        penalties = sum(problem.evidence.groups[g].penalty for g in selection)
        free = problem.linear.design.free_count
        fit = t_likelihood(self.plain.recording, problem.left(selection), free)
        return fit - factor.occam - penalties, self.dense, dict(problem.labels), weights

    def choose(self) -> None:
        """Few laws, or families: by evidence."""
        self.dense = False
        self.problem.labels = dict(self.given)
        self.linearise(NAMED)
        problem = self.problem
        search, families, given = problem.search(problem.laws(False)), problem.families(), problem.selection()
        few = search.climb(given, most=5, swaps=False)
        if self.large:
            problem.keep_families(Level.CALIBRATION)
        many = search.pruned(problem.evidence.tuned({**dict.fromkeys(families, 1.0), **given}))
        if self.large:
            many = search.climb(many, most=3, swaps=False)
        problem.evidence.kept = set()
        if problem.evidence.score(few) > problem.evidence.score(many) - FAR_BEHIND:
            few = search.climb({}, most=5)
        self.dense = problem.evidence.score(many) > problem.evidence.score(few)
        problem.take(many if self.dense else few)

    def round(self, number: int) -> None:
        """One look for more, one step of the exact model, and the rows weighted anew."""
        last = number == _ROUNDS - 1
        if self.dense:
            self.linearise(ALL if last else NAMED)
            if number > 0:
                self.problem.take(self.families_and_more(last))
        else:
            # what has no name is asked at first and at last; between, only what is in is settled
            self.linearise(ALL if last or number == 0 else NAMED)
            self.problem.take(self.few(last))
            if self.problem.calibrated():  # few laws beside a family: the arm is off everywhere after all
                self.dense = True
                self.linearise(ALL if last else NAMED)
                self.problem.take(self.families_and_more(last))
        self.move()
        if not last:
            weights, self.rows = weighted_anew(self.state, self._used())
            self.state = settled(replace(self.state, weights=weights), 2)

    def families_and_more(self, last: bool) -> Selection:
        """All families tuned anew, and at the end laws and unnamed parts beside them."""
        problem = self.problem
        start = {**problem.selection(), **dict.fromkeys(problem.families(), 1.0)}
        found = problem.search(problem.laws(False)).pruned(problem.evidence.tuned(start))
        if last:
            allowed = problem.laws(True) + problem.families()
            found = problem.search(allowed).climb(found, most=12, swaps=False)
        return found

    def few(self, last: bool) -> Selection:
        """From what is in; at the end from nothing too, and two at once: the best.

        What has no name joins after what has one, and may then take its place.
        """
        problem = self.problem
        start, named = problem.selection(), problem.laws(False) + problem.families()
        known, every = problem.search(named), problem.search(problem.laws(True) + problem.families())
        stands = problem.stands()
        best = known.tuned(start) if stands else every.climb(known.climb(start))
        if last and not stands:
            again = every.climb(known.climb({})) if start else best
            if problem.evidence.score(again) > problem.evidence.score(best) + BETTER:
                best = again
        if last:
            best = problem.search(problem.laws(False)).paired(best)
        problem.searched(best)
        return best

    def _used(self) -> int:
        linear = self.problem.linear
        count = sum(len(linear.groups[g].columns) for g in self.problem.selection())
        return linear.design.free_count + min(count, self.state.recording.size)

    def move(self, most: float = _LEFT) -> float:
        """The exact model at the selection's values; halved where it leaves the range of the linear columns.

        Args:
            most: times the robust sum of squares may grow; where every step grows more, all stays as it was.

        Returns:
            change of the sum of squares, as a share.
        """
        library = self.problem.library
        wanted = self.problem.values(self.problem.selection())
        before = robust_squares(self.state)
        old = {library.labels[t.label]: t for t in self.state.terms}
        share = 1.0
        for _ in range(4):
            values = {}
            for number in {*wanted, *old}:
                widths = library.fixed[number].widths
                start = old[number].values / widths if number in old else np.zeros(len(widths))
                goal = wanted.get(number, np.zeros(len(widths)))
                values[number] = start + share * (goal - start)
            trial = self._at({k: v for k, v in values.items() if np.any(v)})
            if robust_squares(trial) <= most * before:
                self.state = trial
                break
            share *= 0.5
        return abs(before - robust_squares(self.state)) / max(before, 1e-300)

    def _at(self, values: dict[int, np.ndarray]) -> State:
        terms, now = terms_from(self.problem.library, values), self.state
        return settled(state_of(now.recording, now.setup, terms, now.weights, held=now.held), 3)

    def concluded(self) -> Description:
        """Everything found refitted at the exact model until it stands still, and linearised there."""
        problem = self.problem
        for number in range(_REFITS):
            self.linearise(NAMED)
            if self.dense and number == 0:
                problem.set_members_free()
            problem.take(problem.evidence.tuned(problem.selection(), 1))
            if self.move() < _STILL and number > 0:
                break
        shared = None
        if self.dense and self.large:
            problem.linearise(self.state, NAMED, False, True)
            alike = problem.evidence.tuned(problem.selection(), 1)
            shared = problem.by_label(
                as_errors_are(problem.evidence.posterior(alike), problem.linear, alike, self.rows)
            )
        # on a sound description, unnamed laws are the rivals of every name
        self.linearise(NAMED if self.dense else ALL)
        described = self._described(shared)
        if not self.dense:
            described.calibrated = self.calibrated(described)
        return described

    def _described(self, shared: dict[int, tuple[np.ndarray, np.ndarray]] | None) -> Description:
        problem = self.problem
        selection = problem.evidence.tuned(problem.selection(), 1)
        problem.take(selection)
        posterior = problem.evidence.posterior(selection)
        posterior = as_errors_are(posterior, problem.linear, selection, self.rows)
        return Description(
            self.plain, self.state, problem.linear, problem.evidence, selection,
            posterior, self.dense, self.rows, shared,
        )  # fmt: skip

    def calibrated(self, few: Description) -> Description | None:
        """All calibration beside the few laws, what has no name keeping only what calibration cannot take.

        A few laws are enough to name; but what has no name says nothing of other poses, where an ordinary calibration
        does. Taken where the data are likelier with all of it; where something has no name, what of it earns its place.
        """
        problem, laws = self.problem, dict(self.problem.labels)
        nameless = any(
            problem.library.fixed[n].effect.level == Level.UNKNOWN for n in laws if isinstance(n, int)
        )
        problem.linearise(self.state, NAMED, True, True)
        named = problem.selection()
        ordinary = [g for g in problem.families() if problem.calibrates(g) and g not in named]
        start = {**dict.fromkeys(ordinary, 1.0), **named}
        problem.evidence.kept = set(start)
        selection = problem.evidence.tuned(start)
        # a family's price is that of a claim; that an arm is a little off everywhere is what one expects
        free = sum(problem.evidence.groups[g].penalty for g in ordinary)
        margin = BETTER if few.selection else TAKE  # to say that nothing is wrong is a claim too
        if problem.evidence.score(selection) + free < few.evidence.score(few.selection) + margin:
            if not nameless:
                return None
            problem.evidence.kept, problem.evidence.alike = set(named), set()
            selection = problem.search([]).pruned(problem.evidence.tuned(start))
        if not set(selection) & set(ordinary):
            return None
        problem.take(selection)
        for number in range(_REFITS):  # what left the selection may leave more; after that no step may
            still = self.move(_LEFT if number == 0 else 1.0) < _STILL
            problem.linearise(self.state, NAMED, True, False)
            problem.evidence.kept = set(problem.selection())
            problem.take(problem.evidence.tuned(problem.selection(), 1))
            if still:
                break
        return self._described(None)
