"""Findings for conventions that were undone."""

from __future__ import annotations

from app.diagnosis.kinematic.hypotheses import Written
from app.diagnosis.kinematic.judging import Judgement, quality_of
from app.diagnosis.kinematic.plain import plain_state
from app.diagnosis.models.kinematic.terms import effects
from app.diagnosis.observations.conventions import parameters_of, title_of
from app.diagnosis.result import Alternative, Finding
from app.diagnosis.thresholds.conventions import BESIDE
from app.diagnosis.thresholds.naming import CERTAIN


def convention_findings(written: Written, judgement: Judgement, *, surely: bool) -> tuple[Finding, ...]:
    """One finding a convention, with those that would do as well.

    Args:
        surely: only where they take away most of the error: what is left of it fits no arm of this kind.
    """
    if not written.found:
        return ()
    effect = next(e for e in effects().values() if e.undone)
    without = judgement.before_quality.heldout_rms
    plain, _ = plain_state(written.recording, ())
    undone = quality_of(plain, judgement.kept).heldout_rms
    if surely and undone > BESIDE * without:
        return ()
    out = []
    for convention, alike in written.found:
        others = tuple(Alternative(effect.key, dict(c.place.where), 0.0) for c in alike)
        out.append(
            Finding(
                effect=effect.key,
                where=dict(convention.place.where),
                parameters=parameters_of(convention.place),
                visible=1.0,
                p_value=CERTAIN,
                heldout_rms_without=without,
                heldout_rms_with=undone,
                alternatives=others,
                sentence=effect.sentence(convention.place, ()),
                equation=title_of(convention.place),
            )
        )
    return tuple(out)
