"""What another log of the same arm taught: its laws with their values, and how far these may be otherwise here.

A linear Gaussian model learnt on one log is the prior of the next: its mean is taken for part of the description, its
covariance stays free as one group of columns X L, with L L' the covariance of the values, so that the evidence weighs a
change against it. That is the same as fitting both logs in one problem. Friction may drift from log to log.

Source: Bayesian updating of the linear model, e.g. Gelman et al., Bayesian Data Analysis (2013), section 14.8.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.dynamic.families import families
from app.diagnosis.dynamic.solution import solve
from app.diagnosis.dynamic.study import Study
from app.diagnosis.effects.dynamic._law import SLIP, WIDTH, Law, Torques, turn
from app.diagnosis.effects.effect import Place, Quantity
from app.diagnosis.model import ModelEffect
from app.diagnosis.models.dynamic.library import Candidate, label, nominal
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.result import UNNAMED
from app.diagnosis.thresholds.evidence import DRIFT

if TYPE_CHECKING:
    from app.diagnosis.dynamic.fitting import Fitted


KEY = "known_before"


@dataclass(frozen=True, eq=False)
class Term:
    """One law of the other log: its place, and which of the values are its."""

    law: Law
    place: Place
    part: slice


class KnownBefore(Law):
    """The values of another log, free within their covariance: one group that is always in."""

    key = KEY
    title = "values learnt on another log"
    equation = "tau = X (mean + L w)"
    family = UNNAMED
    follows_load = True
    certain = True

    def __init__(self, terms: tuple[Term, ...], mean: np.ndarray, covariance: np.ndarray):
        self.terms, self.mean = terms, mean
        values, vectors = np.linalg.eigh(covariance)
        kept = values > 1e-14 * max(float(values[-1]), 1e-300)
        self.half = vectors[:, kept] * np.sqrt(values[kept])

    def places(self, situation: State) -> Iterable[Place]:
        return [Place({})]

    def quantities(self, situation: State, place: Place) -> tuple[Quantity, ...]:
        return tuple(Quantity(f"direction{k}", "", 1.0) for k in range(self.half.shape[1]))

    def widths(self, situation: State, place: Place, found: Torques | None = None) -> np.ndarray:
        return np.ones(self.half.shape[1])

    def columns(self, columns: State, place: Place) -> Torques:
        of_joint: dict[int, tuple[list[np.ndarray], list[np.ndarray]]] = {}
        for term in self.terms:
            for joint, values in term.law.columns(columns, term.place).items():
                every, half = of_joint.setdefault(joint, ([], []))
                every.append(values)
                half.append(self.half[term.part])
        return {j: np.hstack(every) @ np.vstack(half) for j, (every, half) in of_joint.items()}

    def turns(self) -> dict[int, tuple[float, float]]:
        """How dry friction of each joint turned on that log."""
        out = {}
        for place in (term.place for term in self.terms if term.law.blunt):
            if WIDTH in place.fixed and "source_joint" not in place.where:
                out[int(place.where["joint"]) - 1] = (place.fixed[WIDTH], place.fixed.get(SLIP, 0.0))
        return out

    def effects(self, weights: np.ndarray | None = None) -> tuple[ModelEffect, ...]:
        """The laws with their values, moved by `weights` along the columns."""
        values = self.mean if weights is None else self.mean + self.half @ weights
        return tuple(
            ModelEffect(t.law.key, dict(t.place.where), t.law.saved(t.place, values[t.part]), named=False)
            for t in self.terms
        )


def known_from(fitted: Fitted) -> KnownBefore:
    """What a fitted log taught, all families asked for their values whether they were selected or not.

    Where structure is left, drive gains are not asked: they would bend to it, and masses with them.
    """
    asked = fitted.asked
    chosen, left = dict(asked.selection), bool(fitted.left.any())
    every = [(g, asked.label(g).law) for g in families(asked)]
    for g in (g for g, law in every if law.lasting and not (left and law.undone)):
        own = set(asked.group(g).columns.tolist())
        if g not in chosen:
            inside = [k for k in chosen if set(asked.group(k).columns.tolist()) <= own]
            chosen = {k: v for k, v in chosen.items() if k not in inside}
            chosen[g] = nominal(asked.group(g))
    before = asked.selection
    asked.selection = chosen  # what was so once stays in beside the rest, or its torque would bend what lasts
    study = Study(fitted.study.samples, stretch=asked.stretch, known=fitted.study.known, like=asked)
    asked.selection = before
    held = [g for g in study.selection if study.label(g).held]
    solution = solve(study, plain=left, held=held, gains=False)
    terms, columns = [], []
    for candidate, own in _members(study, held):
        place = candidate.place
        if candidate.law.blunt and "joint" in place.where:
            of = [int(place.where[k]) - 1 for k in ("joint", "source_joint") if k in place.where]
            place = Place(place.where, {**place.fixed, **turn(study.state, *of)})
        terms.append(Term(candidate.law, place, slice(len(columns), len(columns) + len(own))))
        columns += own.tolist()
    weights, covariance = solution.of(np.array(columns, int))
    scale = study.design.scale[columns]
    mean, covariance = weights * scale, covariance * scale[:, None] * scale
    for term in terms:
        if term.law.drifts:
            covariance[term.part, term.part] += np.diag((DRIFT * mean[term.part]) ** 2)
    return KnownBefore(tuple(terms), mean, covariance)


def _tells(candidate: Candidate) -> bool:
    """True for what another log of the arm has too: no event, no rest, no course of time without a name."""
    named_time = candidate.law.family == UNNAMED and candidate.place.where.get("driver") == "time"
    return candidate.law.lasting and not candidate.law.windowed and not named_time


def _members(study: Study, held: list[int]):
    inside = [set(study.group(g).columns.tolist()) for g in study.selection if study.label(g).whole]
    for g in study.selection:
        candidate = study.label(g)
        known = isinstance(candidate.law, KnownBefore) or not _tells(candidate)
        if not candidate.whole and g not in held and not known:
            yield candidate, study.group(g).columns
    for group in study.evidence.groups:
        own, candidate = set(group.columns.tolist()), label(group)
        if any(own <= part for part in inside) and not candidate.whole and _tells(candidate):
            yield candidate, group.columns
