"""One log under one hypothesis: which laws the evidence holds, in rounds of noise, selection and renewal."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from app.diagnosis.dynamic.bending import bend, reshape
from app.diagnosis.dynamic.events import Events
from app.diagnosis.dynamic.families import families
from app.diagnosis.dynamic.following import follow_load
from app.diagnosis.dynamic.rules import Rules
from app.diagnosis.dynamic.sharpness import learnt_turns
from app.diagnosis.effects.dynamic._law import Law
from app.diagnosis.effects.effect import Place
from app.diagnosis.models.dynamic.design import TorqueDesign
from app.diagnosis.models.dynamic.library import NOTHING, Candidate, build, group_of, label
from app.diagnosis.models.dynamic.noise import (
    Whitener,
    band_of,
    excess,
    over_all,
    spectrum,
    without_bursts,
    without_spikes,
)
from app.diagnosis.models.dynamic.samples import Samples
from app.diagnosis.models.dynamic.state import State
from app.diagnosis.regression.evidence import Evidence, Group, Posterior, Selection
from app.diagnosis.selection.search import Search
from app.diagnosis.thresholds.evidence import DENSE_FROM, SCANNED_BELOW, TAKE
from app.diagnosis.thresholds.noise import LEFT_P, LEFT_RATIO

#: Ridge of the fit of everything at once, over the mean diagonal of its scaled Gram matrix.
RIDGE = 1e-4
#: Rounds of noise and selection.
ROUNDS = 3


@dataclass(eq=False)
class Study:
    """The state of the work on one log.

    Args:
        samples: the log's windows under its hypothesis.
        without: laws that are not asked.
        stretch: key of a law -> how far its values may be off, over their nominal widths.
        first: keys of laws that a climb starts from too.
        single: keys of laws that are asked at one place at a time, and not as a family.
        known: (M, n) torque of laws that are taken for part of the description [Nm].
        prior: what another log taught; its values are in `known`, its covariance is a group that is always in.
        like: a study whose selection is taken over, on other windows: nothing else is asked, the noise is as there.
        kept: laws that stay in, key and joint (0 for the whole arm): the hypothesis holds their value already.
    """

    samples: Samples
    without: frozenset[str] = frozenset()
    stretch: Mapping[str, float] = field(default_factory=dict)
    known: np.ndarray | None = None
    kept: frozenset[tuple[str, int]] = frozenset()
    like: Study | None = None
    prior: Law | None = None
    first: tuple[str, ...] = ()
    single: frozenset[str] = frozenset()
    state: State = field(init=False)
    design: TorqueDesign = field(init=False)
    evidence: Evidence = field(init=False)
    events: Events = field(init=False)
    selection: Selection = field(init=False, default_factory=dict)
    leftover_p: np.ndarray = field(init=False)
    leftover_ratio: np.ndarray = field(init=False)
    rules: Rules = field(init=False)

    def __post_init__(self) -> None:
        samples = self.samples
        if self.like is None:
            turn = learnt_turns(samples, {} if self.prior is None else self.prior.turns())
        else:
            turn = self.like.state.width, self.like.state.slip
        self.rigid = (
            samples.state.torque
        )  # with the masses and loads of laws taken for part of the description
        self.state = samples.state.with_turn(*turn)
        self.base = samples.description if self.known is None else samples.description + self.known
        self.y = (samples.y - self.base) * samples.alive
        self.leftover_p, self.leftover_ratio = np.ones(self.y.shape[1]), np.ones(self.y.shape[1])
        whiteners = None if self.like is None else self.like.design.whiteners
        self.design = TorqueDesign(self.y, whiteners, samples.alive)
        self.evidence = Evidence(self.design, [], unit_noise=True)
        self.rules = Rules(self.evidence, self.state.joints, self.without)
        self.events = Events(self.design, self.evidence, self.state, self.without)
        if self.like is not None:
            self._as(self.like)
            return
        groups = build(
            self.design, self.state, without=self.without, stretch=self.stretch, single=self.single
        )
        self.evidence.groups.extend(groups)
        self.evidence.kept = {g for g, group in enumerate(groups) if label(group).identity in self.kept}
        if self.prior is not None:
            self.evidence.kept.add(self.add(self.prior, Place({})))
        self.band = band_of(np.hstack([samples.description, samples.state.qd]), samples.step)
        self._first_noise()

    def _as(self, like: Study) -> None:
        """The selection of another study on these windows, members of families one by one beside their family."""
        self.band = like.band
        self.leftover_p, self.leftover_ratio = like.leftover_p, like.leftover_ratio
        wanted: list[Candidate] = []
        plan: list[tuple[int, float, slice]] = []  # group there, its width, and its laws among those wanted
        for g, gamma in like.selection.items():
            candidate, first = like.label(g), len(wanted)
            if candidate.whole:
                wanted += like.inside(g)
            else:
                wanted.append(Candidate(candidate.law, candidate.fresh(self.state), candidate.needs))
            plan.append((g, gamma, slice(first, len(wanted))))
        numbers = self.add_all(wanted, like.stretch)
        for g, gamma, part in plan:
            own, group = numbers[part], like.group(g)
            if like.label(g).whole:
                columns = np.concatenate([self.group(m).columns for m in own])
                own = [len(self.evidence.groups)]
                self.evidence.groups.append(
                    Group(
                        columns,
                        group.penalty,
                        widths=group.widths,
                        label=group.label,
                        exclusive=group.exclusive,
                    )
                )
            self.selection[own[0]] = gamma
        drawn = without_spikes
        for _ in range(2):
            fitted = self.fitted()
            left = self.y - fitted
            self.design.y = np.stack([f + drawn(r) for f, r in zip(fitted.T, left.T, strict=True)], axis=1)
            follow_load(self)
            self.design.whiten(self.design.whiteners, self.design.y)

    # ------------------------------------------------------------------ noise

    def _first_noise(self) -> None:
        """Noise of each joint from what is left by everything at once, spikes drawn in."""
        drawn, whiteners = self.y.copy(), []
        for j in range(self.design.joints):
            columns = self.design.raw[j]
            if not columns.shape[1]:
                whiteners.append(Whitener(1.0))
                continue
            gram = self.design.raw_gram(j)
            size = np.sqrt(np.diag(gram) / len(self.y))
            kept = np.flatnonzero(size > 1e-12)
            scale = np.zeros(len(size))
            scale[kept] = 1.0 / size[kept]
            scaled = gram[np.ix_(kept, kept)] * scale[kept, None] * scale[kept]
            scaled[np.diag_indices_from(scaled)] += RIDGE * len(self.y)
            weights = np.zeros(len(size))
            weights[kept] = np.linalg.solve(scaled, (columns.T @ self.y[:, j])[kept] * scale[kept])
            fitted = columns @ (weights * scale)
            residual = without_spikes(self.y[:, j] - fitted)
            drawn[:, j] = fitted + residual
            taken = min(0.5 * len(kept), 60.0)
            quiet = without_bursts(residual)  # else an event would have to stand out of itself
            whiteners.append(over_all(spectrum(quiet, self.samples.step, self.band, taken)))
        self.design.whiten(whiteners, drawn)

    def renew(self) -> None:
        """Noise and spikes from what the selected model leaves; columns that follow the load from the fitted load."""
        fitted = self.fitted()
        residual = self.y - fitted
        drawn, whiteners = self.y.copy(), []
        counts = self.design.counts(self.posterior().columns)
        p, ratio = np.ones(self.design.joints), np.ones(self.design.joints)
        for j in range(self.design.joints):
            left = without_spikes(residual[:, j])
            drawn[:, j] = fitted[:, j] + left
            found = spectrum(left, self.samples.step, self.band, counts[j])
            p[j], ratio[j] = excess(found)
            whiteners.append(over_all(found))
        self.leftover_p, self.leftover_ratio = p, ratio
        follow_load(self)
        self.design.whiten(whiteners, drawn)
        self.events.forget()

    # ------------------------------------------------------------------ selection

    def select(self, start: Selection | None = None) -> None:
        """Climbs from a start, or from nothing and from all families at once; the higher evidence stays."""
        search = Search(
            self.evidence, self.rules.opens, self.events.offers, self.rules.bound, take=TAKE, drop=TAKE,
            eager=False, dear=SCANNED_BELOW, replaces=True,
        )  # fmt: skip
        kept = dict.fromkeys(self.evidence.kept, 1.0)
        if start is not None:
            self.selection = search.climb({**kept, **start})
            return
        self.selection = search.climb(kept)
        first = {g: 1.0 for g in self.rules.opens(kept) if self.label(g).law.key in self.first}
        starts = [first] if first else []
        if len(self.selection) > DENSE_FROM:
            starts.append({**families(self), **first})
        for more in starts:
            found = search.climb({**kept, **more})
            if self.evidence.score(found) > self.evidence.score(self.selection):
                self.selection = found

    def inside(self, g: int) -> list[Candidate]:
        """The laws of a family that are not selected one by one beside it."""
        family, columns = self.label(g).law, set(self.group(g).columns.tolist())
        found = [(label(x), x) for k, x in enumerate(self.evidence.groups) if k not in self.selection]
        return [
            Candidate(c.law, c.place, c.needs)
            for c, x in found
            if c.law is family and not c.whole and set(x.columns.tolist()) <= columns
        ]

    def add(self, law, place, needs: str = "", stretch: Mapping[str, float] = NOTHING) -> int:
        """A group of its own for a law at a place; its number."""
        return self.add_all([Candidate(law, place, needs)], stretch)[0]

    def add_all(self, wanted: Sequence[Candidate], stretch: Mapping[str, float] = NOTHING) -> list[int]:
        """The same for several laws at once."""
        blocks = [(c.law.block(self.state, c.place), stretch.get(c.law.key, 1.0)) for c in wanted]
        columns = self.design.add([(found, widths * wide) for (found, widths), wide in blocks])
        first = len(self.evidence.groups)
        self.evidence.groups += [group_of(c, own) for c, own in zip(wanted, columns, strict=True)]
        return list(range(first, len(self.evidence.groups)))

    def run(self, start: Sequence[Candidate] | None = None) -> None:
        """Selection, and renewal of noise, load and shapes, until nothing changes.

        Args:
            start: laws selected under another hypothesis.
        """
        self.select(None if start is None else self._found(start))
        for _ in range(ROUNDS):
            reshape(self)
            before = set(self.selection)
            bend(self)
            self.renew()
            self.select(self.selection)
            if set(self.selection) == before:
                break
        self.renew()

    def _found(self, start: Sequence[Candidate]) -> Selection:
        """Groups for laws at places; those that are not in the library (events, bent shapes) are made."""
        at = {label(g).seat: i for i, g in enumerate(self.evidence.groups)}
        out: Selection = {}
        for c in start:
            own = at.get(c.seat)
            out[self.add(c.law, c.place, c.needs) if own is None else own] = 1.0
        return out

    # ------------------------------------------------------------------ reading

    @property
    def left(self) -> np.ndarray:
        """(n,) True where structure is left on a joint."""
        return (self.leftover_p < LEFT_P) & (self.leftover_ratio > LEFT_RATIO)

    def group(self, g: int) -> Group:
        return self.evidence.groups[g]

    def label(self, g: int) -> Candidate:
        return label(self.evidence.groups[g])

    def posterior(self) -> Posterior:
        return self.evidence.posterior(self.selection)

    def fitted(self) -> np.ndarray:
        """(M, n) torque of the selected laws [Nm]."""
        found = self.posterior()
        return self.design.prediction(found.columns, found.weights)

    def values(self, g: int) -> tuple[np.ndarray, np.ndarray]:
        """Linear values (d,) and covariance (d, d) of a group, SI."""
        group = self.group(g)
        weights, covariance = self.posterior().of(group.columns)
        scale = self.design.scale[group.columns]
        return weights * scale, covariance * scale[:, None] * scale
