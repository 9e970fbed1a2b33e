"""Measured and simulated torque of every joint over time, contact windows shaded."""

from __future__ import annotations

import numpy as np

from app.diagnosis.report.drawing.traces import trace_plot
from app.diagnosis.report.parts.case import Case, figure, key, mark, section, table
from app.diagnosis.report.picture_words import in_language
from app.diagnosis.report.wording import digits, fall
from app.diagnosis.result import Diagnosis, Evidence


def windows_of(diagnosis: Diagnosis) -> list[tuple[float, float]]:
    """Spans of time [s] that findings point at; an open end runs to the end of the recording."""
    evidence = diagnosis.evidence
    end = (
        float(evidence.seconds[-1])
        if evidence is not None and evidence.seconds is not None and len(evidence.seconds)
        else np.inf
    )
    return [
        (float(f.where["from_s"]), float(f.where.get("to_s", end)))
        for f in diagnosis.findings
        if f.where.get("from_s") is not None
    ]


def timeline(case: Case) -> str:
    """Nothing for recordings that are no torques over time."""
    d, evidence = case.diagnosis, case.diagnosis.evidence
    if evidence is None or evidence.unit != "Nm" or evidence.seconds is None or len(evidence.seconds) < 2:
        return ""
    windows = windows_of(d)
    count = evidence.measured.shape[1]
    pictures = "".join(
        figure(case.picture(trace_plot(evidence, joint, windows, labelled=joint == count - 1)))
        for joint in range(count)
    )
    more = [mark("m", case.t("key.measured"))]
    if windows:
        more.append(mark("w", case.t("key.window")))
    return section(case.t("title.timeline"), _per_joint(case, evidence), key(case, *more), pictures)


def _per_joint(case: Case, evidence: Evidence) -> str:
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
    heads = ("", *(case.t(f"torques.{key}") for key in ("rms", "before", "after")), "")
    return table(heads, rows, numbers=(1, 2, 3))


def _rms(values: np.ndarray) -> float:
    values = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(values**2))) if len(values) else float("nan")
