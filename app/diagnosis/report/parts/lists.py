"""Rows set aside, poses to record next, notes."""

from __future__ import annotations

from typing import Any

import numpy as np
from markupsafe import Markup

from app.diagnosis.report.parts.case import Case
from app.diagnosis.report.wording import digits, effect_title, place, rivals
from app.diagnosis.wording import in_words
from app.units import deg, mm

MOST_ROWS = 40


def lists(case: Case) -> Markup:
    """What is to be looked at, done and known."""
    return case.section(
        "lists.html",
        outliers=_outliers(case),
        next=_next(case),
        notes=[in_words(note, case.language) for note in case.diagnosis.notes],
    )


def _outliers(case: Case) -> dict[str, Any] | None:
    """Rows that were not used, with how far off they are."""
    d, evidence = case.diagnosis, case.diagnosis.evidence
    if not d.outliers:
        return None
    off = {}
    if evidence is not None:
        size = np.linalg.norm(np.nan_to_num(evidence.after), axis=1)
        size, unit = (mm(size), "mm") if evidence.unit == "m" else (size, "Nm")
        off = {int(row): f"{digits(float(s))} {unit}" for row, s in zip(evidence.rows, size, strict=True)}
    more = len(d.outliers) - MOST_ROWS
    return {
        "heads": (case.t("outliers.line"), case.t("outliers.off")),
        "rows": [(str(row), off.get(row, "–")) for row in d.outliers[:MOST_ROWS]],
        "more": case.t("outliers.more", count=more) if more > 0 else "",
    }


def _next(case: Case) -> dict[str, Any] | None:
    """Poses that would tell the best explanations apart, with the sets of explanations."""
    poses, language = case.diagnosis.next_poses, case.language
    if not poses:
        return None
    slides = case.prismatic or (False,) * len(poses[0])
    heads = ("", *(case.t("next.joint", n=j, unit="mm" if s else "deg") for j, s in enumerate(slides, 1)))
    sets = [
        case.t(
            "next.set",
            one=f"{effect_title(f.effect, language)} ({place(f.where, language)})",
            others=rivals(f, language),
        )
        for f in case.diagnosis.findings
        if f.alternatives
    ]
    return {
        "intro": " ".join([case.t("next.intro"), *sets[:MOST_SETS]]),
        "heads": heads,
        "rows": [
            (str(n), *(f"{mm(v):.1f}" if s else f"{deg(v):.1f}" for v, s in zip(q, slides, strict=True)))
            for n, q in enumerate(poses, 1)
        ],
        "numbers": range(1, len(heads)),
    }


#: Sets of rivals named above the poses.
MOST_SETS = 3
