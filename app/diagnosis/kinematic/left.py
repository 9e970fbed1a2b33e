"""What is left over: unnamed parts of the model, and more than the noise that is known."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from app.diagnosis.effects.effect import Level
from app.diagnosis.kinematic import budget
from app.diagnosis.kinematic.description import Description
from app.diagnosis.kinematic.findings import imitated
from app.diagnosis.kinematic.judging import quality_of
from app.diagnosis.models.kinematic.candidates import Candidate
from app.diagnosis.observations.noise import residual_rms
from app.diagnosis.result import UNNAMED, Noise
from app.diagnosis.thresholds.naming import CANCELLING, UNNAMED_SHARE
from app.diagnosis.thresholds.noise import EXCESS_SIGMA, HEAVY_TAILS, HOPELESS
from app.diagnosis.thresholds.rows import OUTLIER_SHARE
from app.units import from_mm

if TYPE_CHECKING:
    from app.diagnosis.kinematic.judging import Judgement


@dataclass(frozen=True)
class Left:
    """Whether structure remains, where, and how much.

    Args:
        structure: True where more than a small share has no name.
        share: of the mean square of `before`, above noise, without a name.
        p_value: chance of as much beyond the known noise, or e to the minus evidence of the unnamed part.
        noise_ratio: known noise over what is left, squared; 1 where the noise is not known.
        excess: True where more remains than the known noise.
        hopeless: True where measurements and poses do not belong together, or the arm is another one.
        another: the geometry that would have to be off by more than any arm's is; None where none is.
    """

    structure: bool
    where: Mapping[str, Any]
    share: float
    p_value: float
    noise_ratio: float
    excess: bool
    hopeless: bool
    another: tuple[Candidate, float] | None = None


def left_over(
    found: Description, judgement: Judgement, noise: Noise, known_dof: float, freedom: float
) -> Left:
    """Unnamed parts first, then what exceeds a known noise.

    Args:
        known_dof: degrees of freedom from which the noise is known; infinite where it is stated.
        freedom: (0..1) part of the measured values that the fit has not used up.
    """
    unnamed = _unnamed(found)
    where, strongest = {}, 0.0
    whole = found.calibrated or found
    taken = budget.shares(whole, budget.shared_terms(whole), 1.0)
    before = judgement.before_quality.fit_rms**2
    told = min(quality_of(found.plain, judgement.kept).fit_rms ** 2 / max(before, 1e-300), 1.0)
    share = told * taken.get(UNNAMED, 0.0)  # conventions took the rest of `before` away
    cancelling = found.dense and sum(taken.values()) > CANCELLING
    if unnamed:
        score = found.evidence.score(found.selection)
        gains = [
            (score - found.evidence.score({k: v for k, v in found.selection.items() if k != g}), g)
            for g in unnamed
        ]
        strongest, g = max(gains)
        where = dict(found.library.fixed[found.linear.groups[g].label].place.where)  # type: ignore[index]
    excess, ratio, chance = _beyond(found, judgement, noise, known_dof, freedom)
    rival = imitated(found)
    if rival is not None:
        where = where or dict(rival.place.where)
    if excess:
        after = judgement.after_quality.fit_rms**2
        share = max(share, (after / freedom - noise.value**2) / max(before - noise.value**2, 1e-12))
    aside = int((~judgement.kept).sum())
    many = aside > max(1, OUTLIER_SHARE * len(judgement.kept))
    structure = excess or many or cancelling or rival is not None or share > UNNAMED_SHARE
    where = (where or _likeliest(found)) if structure else {}
    p = min(chance, float(np.exp(-max(strongest, 0.0)))) if structure else max(chance, 0.05)
    another = _another_arm(found)
    far = from_mm(judgement.after_quality.fit_rms) > HOPELESS
    hopeless = another is not None or far or _at_one_place(whole)
    share = float(np.clip(share, 0.0, 1.0))
    return Left(structure or hopeless, where, share, p, ratio, excess, hopeless, another)


def _unnamed(found: Description) -> list[int]:
    out = []
    for g in found.selection:
        label = found.linear.groups[g].label
        if isinstance(label, int) and found.library.fixed[label].effect.level == Level.UNKNOWN:
            out.append(g)
    return out


def _beyond(
    found: Description, judgement: Judgement, noise: Noise, known_dof: float, freedom: float
) -> tuple[bool, float, float]:
    """Whether more is left than the known noise, the known noise over it (squared), and a rough p value."""
    if noise.source not in ("repeats", "stated"):
        return False, 1.0, 1.0
    # what is left where the fit has used up freedom, and what is missed where it has not looked
    fit = residual_rms(judgement.after, judgement.kept) / np.sqrt(freedom)
    left = max(fit, from_mm(judgement.after_quality.heldout_rms) * np.sqrt(freedom))
    dof = max(found.linear.design.dof * freedom, 1.0)
    ratio = left / max(from_mm(noise.value), 1e-12)
    sigma = HEAVY_TAILS * np.sqrt(0.5 / dof + 0.5 / known_dof)  # of a ratio of two estimated deviations
    z = (ratio - 1.0) / sigma
    return (
        bool(z > EXCESS_SIGMA),
        float(min(1.0, ratio**-2)),
        float(min(1.0, 2.0 * np.exp(-0.5 * max(z, 0.0) ** 2))),
    )


def _likeliest(found: Description) -> dict[str, Any]:
    """The place and driver along which a smooth unnamed law would explain most of what is left."""
    unknown = [
        g
        for g, group in enumerate(found.linear.groups)
        if isinstance(group.label, int)
        and g not in found.selection
        and found.library.fixed[group.label].effect.level == Level.UNKNOWN
    ]
    if not unknown:
        return {}
    gains, _ = found.evidence.gains(found.selection, unknown)
    best = unknown[int(gains.argmax())]
    return dict(found.library.fixed[found.linear.groups[best].label].place.where)  # type: ignore[index]


def _at_one_place(found: Description) -> bool:
    """Whether the description puts all touched points of different names at one place.

    Touches that are named at random fit best where steps of the base bring all points together.
    """
    targets = found.state.setup.targets
    if len(targets) < 2:
        return False
    apart = np.sqrt(np.mean(np.sum((targets - targets.mean(axis=0)) ** 2, axis=1)))
    return bool(apart < HOPELESS)


def _another_arm(found: Description) -> tuple[Candidate, float] | None:
    """The first member of the fit beyond its physical bounds on either side, and its value [SI]."""
    weights = np.zeros(found.linear.design.size)
    weights[found.posterior.columns] = found.posterior.weights
    for number in found.numbers():
        candidate, columns = found.library.fixed[number], found.linear.columns[number]
        quantities = candidate.effect.quantities(found.library.situation, candidate.place)
        if not len(columns) or not all(np.isfinite([q.lower, q.upper]).all() for q in quantities):
            continue
        for q, value in zip(quantities, weights[columns] * candidate.widths, strict=True):
            if candidate.effect.whole and not q.lower <= value <= q.upper:
                return candidate, float(value)
    return None
