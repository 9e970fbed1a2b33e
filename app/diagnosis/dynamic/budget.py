"""Where the newton-metres come from: share of each family, and the error left out once it and all before it are in."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.dynamic.solution import error_with, heldout_without
from app.diagnosis.model import ModelEffect
from app.diagnosis.models.dynamic.hypothesis import Hypothesis, as_given
from app.diagnosis.models.dynamic.library import laws
from app.diagnosis.models.dynamic.samples import Samples
from app.diagnosis.models.dynamic.saved import Predicted, beside, hypothesis_of, torque_of
from app.diagnosis.result import MOTION_FAMILIES, FamilyShare, Quality
from app.diagnosis.thresholds.naming_logs import LEAST

if TYPE_CHECKING:
    from app.diagnosis.dynamic.fitting import Fitted
    from app.diagnosis.dynamic.names import Member


def budget(
    fitted: Fitted,
    effects: Sequence[ModelEffect],
    whole: Predicted,
    before: np.ndarray,
    noise: float,
    take_as,
    found: Sequence[Member],
    after: Quality,
    read_as: Sequence[ModelEffect],
) -> tuple[FamilyShare, ...]:
    """The families that have a share, in order; the last one's error is that of the whole result.

    Args:
        effects: the saved model.
        whole: it on the log.
        before: (M, n) residual of the description as given.
        noise: mean square of the noise.
        take_as: hypothesis -> samples.
        found: the selected laws with their columns.
        after: errors of the whole result.
        read_as: mounting, delay and factors as the fit holds them.
    """
    used = whole.samples.used
    least = _ms(whole.residual, used)
    total = max(_ms(before, used) - noise, 1e-30)
    of = [laws()[e.effect].family for e in effects]
    present = [f for f in MOTION_FAMILIES if f in of]
    out: list[FamilyShare] = []
    known: dict[tuple, Samples] = {}
    joints = whole.samples.y.shape[1]

    def samples_under(hypothesis: Hypothesis) -> Samples:
        key = hypothesis.key
        if key not in known:
            known[key] = take_as(hypothesis)
        return known[key]

    def read_by(chosen: Sequence[ModelEffect]) -> Hypothesis:
        return hypothesis_of(chosen, joints) if chosen else as_given(joints)

    shares: dict[str, float] = {}
    for family in present:
        rest = [e for e, f in zip(effects, of, strict=True) if f != family]
        without = beside(samples_under(read_by(rest)), rest).residual
        shares[family] = float(np.clip((_ms(without, used) - least) / total, 0.0, 1.0))
    named = {laws()[e.effect].family for e in effects if e.named}
    told = [f for f in present if shares[f] >= LEAST or f in named]
    for k, family in enumerate(told):
        last = k == len(told) - 1
        left = (
            after.heldout_rms
            if last
            else _left(fitted, effects, found, told[: k + 1], samples_under, read_as)
        )
        out.append(FamilyShare(family, shares[family], left, ()))
    return tuple(out)


def _left(
    fitted: Fitted,
    effects: Sequence[ModelEffect],
    found: Sequence[Member],
    kept: Sequence[str],
    samples_under,
    read_as: Sequence[ModelEffect],
) -> float:
    """Held-out error [Nm] of some families alone, everything linear in them refitted."""
    joints, study = fitted.robot.joint_count, fitted.study
    in_kept = lambda e: laws()[e.effect].family in kept  # noqa: E731
    learnt = () if fitted.prior is None else fitted.prior.effects()
    read = [e for e in (*fitted.given, *read_as) if e not in learnt and in_kept(e)]
    read += [e for e in effects if laws()[e.effect].whole_log and in_kept(e)]
    hypothesis = hypothesis_of([*read, *learnt], joints) if read or learnt else as_given(joints)
    own = study.state.hypothesis
    # How far values learnt on another log are off here belongs to no family: it is in from the first.
    in_first = [m for m in found if m.candidate.law.certain or m.candidate.law.family in kept]
    inside = [m for m in in_first if not m.held]
    if hypothesis.key != own.key:
        samples = samples_under(hypothesis)
        return error_with(samples, inside, torque_of(samples, filter(in_kept, _given(fitted, effects))))
    outside = [m.columns for m in found if m not in in_first]
    moved = [e for e in effects if e in _given(fitted, effects) and not in_kept(e)]
    added = torque_of(study.samples, moved)
    columns = np.concatenate(outside) if outside else np.zeros(0, int)
    residual = own.recorded(heldout_without(study, fitted.solution, columns, added))
    samples = study.samples
    return float(np.sqrt(np.mean(residual[samples.used] ** 2) + np.mean(samples.within)))


def _given(fitted: Fitted, effects: Sequence[ModelEffect]) -> list[ModelEffect]:
    """Effects that were taken for part of the description."""
    return list(effects[: len(fitted.given)])


def _ms(residual: np.ndarray, used: np.ndarray) -> float:
    return float(np.mean(residual[used] ** 2)) if used.any() else float("nan")
