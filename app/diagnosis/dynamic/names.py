"""Which of the selected laws are findings: each with its value, its share of the mismatch and its rivals."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import chdtrc

from app.diagnosis.dynamic.solution import Solution
from app.diagnosis.models.dynamic.library import Candidate, laws
from app.diagnosis.result import UNNAMED
from app.diagnosis.thresholds.naming import MEMBER_WALD, MEMBER_WALD_PARAMETER, RIVAL
from app.diagnosis.thresholds.naming_logs import CURVE, NAME, RIPPLES, SHARE, STANDS_OUT

if TYPE_CHECKING:
    from app.diagnosis.dynamic.study import Study


@dataclass(frozen=True, eq=False)
class Member:
    """One law at one place of the selection.

    Args:
        group: number of its group, or of the family's it belongs to.
        columns: (d,) numbers in the design.
        values, covariance: (d,), (d, d) SI.
        gain: evidence lost without it [nats].
        share: of the mean square of `before` above noise that is lost when it is taken out.
        visible: share of its signature that no other selected law can imitate.
        p_value: of so much by chance, over all laws that were asked.
        named: True where it is a finding.
        held: True where the hypothesis has it; `values` are what remains of it.
        alike: other readings of the same columns that its values do not exclude, with the nats that they are worse.
    """

    candidate: Candidate
    group: int
    columns: np.ndarray
    values: np.ndarray
    covariance: np.ndarray
    gain: float
    share: float
    visible: float
    p_value: float
    named: bool
    held: bool = False
    alike: tuple[tuple[Candidate, float], ...] = ()

    @property
    def asks_for_a_name(self) -> bool:
        """True for what is no part of a description within its trust: large and without a name, it is structure."""
        return self.candidate.law.finding and not self.candidate.law.stated


def members(
    study: Study,
    solution: Solution,
    loose: Solution,
    before: np.ndarray,
    noise: float,
    unfinished: np.ndarray,
) -> list[Member]:
    """All laws of the selection, families member by member.

    Args:
        solution: values with what is undone held; loose: with it free.
        before: (M, n) residual of the description as given [Nm].
        noise: mean square of the noise [Nm^2].
        unfinished: (n,) True for joints on which structure is left.
    """
    contained = {
        (c.law.contains, c.place.where.get("joint"))
        for g in study.selection
        if (c := study.label(g)).law.contains
    }
    ripples = waves(study)
    spread = np.array([w.spread for w in study.design.whiteners])
    structure = np.where(unfinished, spread * np.sqrt(np.maximum(1.0 - 1.0 / study.leftover_ratio, 0.0)), 0.0)
    total = max(float(np.mean(before**2)) - noise, 1e-6 * noise, 1e-30)
    left = study.design.y - study.design.prediction(solution.columns, solution.weights)
    out = []
    for g, candidate, columns in _all(study):
        weights, covariance = loose.of(columns)
        held = study.label(g).held
        weights = 0.0 * weights if held else solution.of(columns)[0]
        scale = study.design.scale[columns]
        in_all = _held(study, candidate) if held else weights
        gain, statistic = _worth(study, g, in_all, covariance)
        without = left + study.design.prediction(columns, in_all)
        share = float(np.clip((np.mean(without**2) - np.mean(left**2)) / total, 0.0, 1.0))
        p = float(min(1.0, chdtrc(len(columns), statistic) * len(study.evidence.groups)))
        visible = _visible(study, columns, covariance)
        parameters = candidate.law.saved(candidate.place, weights * scale)
        said = gain >= NAME or (held and share >= SHARE)  # what a log was read without is never silent
        named = said and candidate.law.finding and candidate.law.lawful(parameters)
        if unfinished.any():
            adds = np.sqrt(np.mean(study.design.prediction(columns, in_all) ** 2, axis=0))
            large = share >= SHARE or study.prior is not None  # against another log, CHANGE decides
            named = named and large and bool(np.any((adds > 0) & (adds >= STANDS_OUT * structure)))
        if candidate.law.series:
            named = named and ripples[candidate.place.where["joint"]] <= RIPPLES
        named = named and (candidate.law.key, candidate.place.where.get("joint")) not in contained
        named = named and candidate.law.family != UNNAMED
        # The description's masses are trusted only so far, but they do not change from one log to the next.
        named = named and (study.prior is not None or candidate.law.beyond_trust(weights))
        if study.label(g).whole:
            needed = MEMBER_WALD + MEMBER_WALD_PARAMETER * (len(columns) - 1)
            named = named and statistic > needed
        out.append(
            Member(
                candidate, g, columns, weights * scale, covariance * scale[:, None] * scale, gain, share, visible,
                p, named, held,
            )
        )  # fmt: skip
    return [replace(m, named=m.named and not _shaped(m, out) and not _part_of_another(m, out)) for m in out]


def _part_of_another(member: Member, found: list[Member]) -> bool:
    """True for an event that lies in the time of a far larger one of its kind: it only gives that its shape."""
    if not member.candidate.law.windowed:
        return False
    first, last = _times(member)
    others = [m for m in found if m is not member and m.candidate.law.key == member.candidate.law.key]
    return any(
        start < last and first < end and member.share < SHARE * m.share
        for m in others
        for start, end in [_times(m)]
    )


def _times(member: Member) -> tuple[float, float]:
    where = member.candidate.place.where
    return float(where.get("from_s", -np.inf)), float(where.get("to_s", np.inf))


def _shaped(member: Member, found: list[Member]) -> bool:
    """True where an unnamed curve along the same driver of the joint explains a good part of it."""
    joint = member.candidate.place.where.get("joint")
    driver = member.candidate.place.where.get("driver", member.candidate.law.driver)
    curves = [
        m for m in found
        if m.candidate.law.family == UNNAMED and m.candidate.place.where.get("joint") == joint
        and m.candidate.place.where["driver"] == driver
    ]  # fmt: skip
    return any(m.share > CURVE * member.share for m in curves)


def waves(study: Study) -> dict[object, int]:
    """How many terms of a series each joint has: waves of its own angle."""
    out: dict[object, int] = {}
    for g in study.selection:
        if study.label(g).law.series:
            joint = study.label(g).place.where["joint"]
            out[joint] = out.get(joint, 0) + 1
    return out


def _all(study: Study):
    """Group number, law and place, columns of every member of the selection."""
    chosen = set(study.selection)
    for g in study.selection:
        candidate = study.label(g)
        if candidate.law.key not in laws():  # values learnt on another log
            continue
        if not candidate.whole:
            yield g, candidate, study.group(g).columns
            continue
        inside = set(study.group(g).columns.tolist())
        for k, group in enumerate(study.evidence.groups):
            own = study.label(k)
            if (
                k not in chosen
                and own.law is candidate.law
                and not own.whole
                and set(group.columns.tolist()) <= inside
            ):
                yield g, own, group.columns


def _held(study: Study, candidate: Candidate) -> np.ndarray:
    """Weights by which the columns of an undone law stand for what the hypothesis holds of it already."""
    law, place = candidate.law, candidate.place
    return law.held(study.state.hypothesis, place) / law.widths(study.state, place)


def _worth(study: Study, g: int, weights: np.ndarray, covariance: np.ndarray) -> tuple[float, float]:
    """Evidence of a member [nats], and its Wald statistic."""
    prior = study.selection[g]
    values, vectors = np.linalg.eigh(covariance)
    good = values > 1e-12 * values[-1]
    along = vectors[:, good].T @ weights
    statistic = float(np.sum(along**2 / values[good]))
    occam = 0.5 * float(np.sum(np.log(np.minimum(values[good] / prior, 1.0))))
    return 0.5 * statistic + occam - study.group(g).penalty, statistic


def _visible(study: Study, columns: np.ndarray, covariance: np.ndarray) -> float:
    alone = np.maximum(np.diag(study.design.matrix)[columns], 1e-12)
    beside = 1.0 / np.maximum(np.diag(covariance), 1e-300)
    return float(np.sqrt(np.clip(np.max(beside / alone), 0.0, 1.0)))


def rivals(study: Study, member: Member) -> tuple[tuple[Candidate, float], ...]:
    """Other laws at the same place that explain about as much beside the rest of the selection."""
    own = [g for g in study.selection if _same(study.label(g), member.candidate)]
    if not own or own[0] in study.evidence.kept or own[0] in study.rules.bound(study.selection):
        return ()
    g = own[0]
    rest = {k: v for k, v in study.selection.items() if k != g}
    allowed = [k for k in study.rules.opens(rest) if k == g or _same_place(study.label(k), member.candidate)]
    gains, _ = study.evidence.gains(rest, allowed)
    own_gain = float(gains[allowed.index(g)]) if g in allowed else member.gain
    found: dict[tuple, tuple[Candidate, float]] = {}
    for k, gain in zip(allowed, gains, strict=True):
        other = study.label(k)
        short = own_gain - float(gain)
        key = (other.law.key, tuple(sorted(other.place.where.items())))
        same = other.law is member.candidate.law and (  # an event at a slightly other time is the same one
            other.law.windowed or other.place.where == member.candidate.place.where
        )
        if k != g and not same and short < RIVAL and other.law.family != UNNAMED and key not in found:
            found[key] = (other, max(short, 0.0))
    return tuple(sorted(found.values(), key=lambda pair: pair[1]))[:6]


def _same(a: Candidate, b: Candidate) -> bool:
    return a.law is b.law and not a.whole and a.place.where == b.place.where


def _same_place(a: Candidate, b: Candidate) -> bool:
    """True where both sit at one joint or link, or act on the whole arm."""
    if a.whole:
        return False
    where, other = a.place.where, b.place.where
    here = where.get("joint", where.get("link", 0))
    there = other.get("joint", other.get("link", 0))
    if not here or not there:  # of the whole arm: a load and the last link's masses are one place
        return True
    return here == there


def differs(study: Study, member: Member) -> bool:
    """Is a law another one than in a reference log, or was it there, only too small in that motion to be taken?

    The reference is asked for its values beside all it has; they differ where the Wald statistic of the difference
    is that of a finding. What was taken for part of the description is a change as such.
    """
    law, place = member.candidate.law, member.candidate.place
    there = [study.label(g) for g in study.selection]
    had = any(c.law is law and (c.whole or c.place.where == place.where) for c in there)
    if had or law.windowed or law.carried or (law.whole and law.lasting):
        return True
    g = study.add(law, place)
    columns = study.group(g).columns
    weights, covariance = study.evidence.posterior({**study.selection, g: 1.0}).of(columns)
    scale = study.design.scale[columns]
    apart = member.values - weights * scale
    both = member.covariance + covariance * scale[:, None] * scale
    needed = MEMBER_WALD + MEMBER_WALD_PARAMETER * (len(columns) - 1)
    return float(apart @ np.linalg.pinv(both) @ apart) > needed
