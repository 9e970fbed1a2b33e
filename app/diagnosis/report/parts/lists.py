"""Rows set aside, poses to record next, notes."""

from __future__ import annotations

from html import escape

import numpy as np

from app.diagnosis.report.parts.case import Case, section, soft, table
from app.diagnosis.report.wording import digits, place, probability
from app.diagnosis.wording import in_words
from app.units import deg, mm

MOST_ROWS = 40


def leftover(case: Case) -> str:
    """What remains, in one paragraph."""
    d = case.diagnosis
    p = probability(d.leftover.p_value, case.language)
    if d.verdict in ("clean", "named"):
        said = case.t("leftover.nothing", p=p)
    else:
        said = case.t("leftover.structure", p=p, where=place(d.leftover.where, case.language))
    return section(case.t("title.leftover"), f"<p>{escape(said)}</p>")


def outliers(case: Case) -> str:
    """Rows that were not used, with how far off they are."""
    d, evidence = case.diagnosis, case.diagnosis.evidence
    if not d.outliers:
        return ""
    off = {}
    if evidence is not None:
        size = np.linalg.norm(np.nan_to_num(evidence.after), axis=1)
        size, unit = (mm(size), "mm") if evidence.unit == "m" else (size, "Nm")
        off = {int(row): f"{digits(float(s))} {unit}" for row, s in zip(evidence.rows, size, strict=True)}
    rows = [(str(row), off.get(row, "–")) for row in d.outliers[:MOST_ROWS]]
    more = len(d.outliers) - MOST_ROWS
    note = soft(case.t("outliers.more", count=more)) if more > 0 else ""
    # The quotes of this one stay as they were: a page made again is the same to the last byte.
    intro = f"<p class='small soft'>{escape(case.t('outliers.intro'))}</p>"
    listed = table((case.t("outliers.line"), case.t("outliers.off")), rows, numbers=(1,), fit=True)
    return section(case.t("title.outliers"), intro, listed, note)


def next_poses(case: Case) -> str:
    """Poses that would tell the best explanations apart."""
    poses = case.diagnosis.next_poses
    if not poses:
        return ""
    slides = case.prismatic or (False,) * len(poses[0])
    heads = ("", *(case.t("next.joint", n=j, unit="mm" if s else "deg") for j, s in enumerate(slides, 1)))
    rows = [
        (str(n), *(f"{mm(v):.1f}" if s else f"{deg(v):.1f}" for v, s in zip(q, slides, strict=True)))
        for n, q in enumerate(poses, 1)
    ]
    return section(
        case.t("title.next"),
        soft(case.t("next.intro")),
        table(heads, rows, numbers=range(1, len(heads))),
    )


def notes(case: Case) -> str:
    """What a reader should know about the recording or how it was read."""
    said = "".join(f"<li>{escape(in_words(note, case.language))}</li>" for note in case.diagnosis.notes)
    return section(case.t("title.notes"), f"<ul>{said}</ul>" if said else "")
