"""From a fit to what a person reads: findings with their uncertainty, share, improvement and rivals."""

from __future__ import annotations

import numpy as np

from app.diagnosis.result import Finding, Quality
from app.diagnosis.static.alternatives import alternatives_of
from app.diagnosis.static.fit import Fitted, covariance
from app.diagnosis.static.heldout import KEPT, heldout_squares, interleaved
from app.diagnosis.static.library import Candidate
from app.diagnosis.static.looking import visible_share, without
from app.diagnosis.static.noise import component_rms
from app.units import mm

#: Growth of the held-out error without a finding that is no chance where structure remains.
STRONG = 1.05


def findings_of(
    fitted: Fitted,
    p_values: dict[tuple, float],
    wanted: tuple[Candidate, ...],
    shadows: frozenset[tuple] = frozenset(),
) -> tuple[Finding, ...]:
    """One finding a term that is neither tacit nor a shadow.

    Args:
        p_values: family-wise, by the term's label.
    """
    spread = covariance(fitted)
    heldout = heldout_position(fitted)
    out = []
    situation = fitted.recording.situation
    for index, term in enumerate(fitted.terms):
        if term.tacit or term.label in shadows:
            continue
        where = fitted.slices[index]
        parameters = term.effect.report(situation, term.place, term.values, spread[where, where])
        out.append(
            Finding(
                effect=term.effect.key,
                where=dict(term.where),
                parameters=parameters,
                visible=visible_share(fitted, index),
                p_value=p_values.get(term.label, float("nan")),
                heldout_rms_without=heldout_position(fitted, index),
                heldout_rms_with=heldout,
                alternatives=alternatives_of(fitted, index, wanted),
                sentence=term.effect.sentence(term.place, parameters),
                equation=term.effect.equation,
            )
        )
    return tuple(out)


def strong(findings: tuple[Finding, ...]) -> tuple[Finding, ...]:
    """Those whose removal clearly shows on rows left out: where structure remains, the others may be its shadow."""
    return tuple(f for f in findings if f.heldout_rms_without > STRONG * f.heldout_rms_with)


def heldout_position(fitted: Fitted, leave: int | None = None) -> float:
    """Held-out error of the position components [mm], optionally with one term taken out.

    The whitened held-out error is brought back by the spread of the position components.
    """
    jacobian, white = (fitted.jacobian, fitted.white) if leave is None else without(fitted, leave)
    recording = fitted.recording
    metric = (fitted.weights > 0) & ~recording.angular
    sigma = 1.0 / float(fitted.weights[:, ~recording.angular].max(initial=1e-300))
    ghosts = np.zeros((fitted.ghosts, metric.shape[1]), bool)
    fold = np.concatenate([interleaved(recording.pose), np.full(fitted.ghosts, KEPT)])
    total, count = heldout_squares(
        jacobian, white, fold, fitted.rows, counted=np.concatenate([metric, ghosts]).reshape(-1)
    )
    return mm(sigma * float(np.sqrt(total / max(count, 1))))


def quality(fitted: Fitted) -> Quality:
    """Fit and held-out error of the position components [mm]."""
    return Quality(
        fit_rms=mm(component_rms(fitted, ~fitted.recording.angular, corrected=False)),
        heldout_rms=heldout_position(fitted),
        unit="mm",
    )
