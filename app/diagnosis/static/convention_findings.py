"""Findings for conventions that were undone."""

from __future__ import annotations

from app.diagnosis.result import Alternative, Finding, Quality
from app.diagnosis.static.conventions import title_of
from app.diagnosis.static.findings import heldout_position
from app.diagnosis.static.library import effects
from app.diagnosis.static.outcome import Outcome

#: A misfit that falls to a third on every pose at once leaves nothing to chance.
_CERTAIN = 1e-300


def convention_findings(outcome: Outcome, after: Quality) -> tuple[Finding, ...]:
    """One finding a convention, with those that would do as well."""
    effect = effects().get("wrong_convention")
    if effect is None or not outcome.written.found or outcome.written.before is None:
        return ()
    without = heldout_position(outcome.written.before)
    out = []
    for convention, alike in outcome.written.found:
        others = tuple(Alternative(effect.key, dict(c.place.where), 0.0) for c in alike)
        out.append(
            Finding(
                effect=effect.key,
                where=dict(convention.place.where),
                parameters=(),
                visible=1.0,
                p_value=_CERTAIN,
                heldout_rms_without=without,
                heldout_rms_with=after.heldout_rms,
                alternatives=others,
                sentence=effect.sentence(convention.place, ()),
                equation=title_of(convention.place),
            )
        )
    return tuple(out)
