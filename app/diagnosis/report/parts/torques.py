"""Torque of every joint: how much of its error each family explains, over time too, with events on the axis."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup

from app.diagnosis.report.budget import family_name, in_order
from app.diagnosis.report.drawing.joint_bars import joint_bars
from app.diagnosis.report.drawing.palette import NOISE, colour
from app.diagnosis.report.drawing.traces import trace_plot
from app.diagnosis.report.events import events_of
from app.diagnosis.report.parts.case import Case
from app.diagnosis.report.picture_words import in_language
from app.diagnosis.report.wording import digits, fall
from app.diagnosis.result import Evidence


def torques(case: Case) -> Markup | str:
    """Nothing for recordings that are no torques over time."""
    d, evidence = case.diagnosis, case.diagnosis.evidence
    if evidence is None or evidence.unit != "Nm" or evidence.seconds is None or len(evidence.seconds) < 2:
        return ""
    events = events_of(d)
    count = evidence.measured.shape[1]
    marks = [("m", case.t("key.measured"))] + ([("w", case.t("key.window"))] if events else [])
    families = [(colour(f), family_name(f, case.language)) for f in in_order(evidence.parts)]
    if families:
        families.append((NOISE, family_name("rest", case.language)))
    return case.section(
        "torques.html",
        heads=("", *(case.t(f"torques.{key}") for key in ("rms", "before", "after")), ""),
        rows=_per_joint(case, evidence),
        bars=case.picture(joint_bars(evidence)),
        intro=case.t("torques.stacked" if families else "torques.plain"),
        marks=case.marks(*marks),
        families=families,
        pictures=[
            case.picture(trace_plot(evidence, joint, events, labelled=joint == count - 1))
            for joint in range(count)
        ],
    )


def _per_joint(case: Case, evidence: Evidence) -> list[tuple[str, ...]]:
    rows = []
    for k, name in enumerate(evidence.components):
        before, after = (_rms(r[:, k][evidence.kept]) for r in (evidence.before, evidence.after))
        rows.append(
            (
                in_language(name, case.language),
                digits(_rms(evidence.measured[:, k])),
                digits(before),
                digits(after),
                fall(before, after, case.language),
            )
        )
    return rows


def _rms(values: np.ndarray) -> float:
    values = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(values**2))) if len(values) else float("nan")
