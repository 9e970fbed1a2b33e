"""Rows set aside, poses to record next, notes."""

from __future__ import annotations

from html import escape

import numpy as np

from app.diagnosis.report.parts.case import Case, section, table
from app.diagnosis.report.wording import digits, place, probability
from app.units import deg, mm

MOST_ROWS = 40


def leftover(case: Case) -> str:
    """What remains, in one paragraph."""
    d = case.diagnosis
    if d.verdict in ("clean", "named"):
        said = f"Nothing beyond noise ({probability(d.leftover.p_value)})."
    else:
        said = (
            f"Structure that the model does not explain ({probability(d.leftover.p_value)}). "
            f"Seen at: {place(d.leftover.where)}."
        )
    return section("What is left over", f"<p>{escape(said)}</p>")


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
    note = f'<p class="small soft">and {more} more</p>' if more > 0 else ""
    intro = "<p class='small soft'>Too far off to belong to the rest; look at them before anything else.</p>"
    return section(
        "Rows set aside", intro, table(("line of the file", "off by"), rows, numbers=(1,), fit=True), note
    )


def next_poses(case: Case) -> str:
    """Poses that would tell the best explanations apart."""
    poses = case.diagnosis.next_poses
    if not poses:
        return ""
    slides = case.prismatic or (False,) * len(poses[0])
    heads = ("", *(f"joint {j} [{'mm' if s else 'deg'}]" for j, s in enumerate(slides, 1)))
    rows = [
        (str(n), *(f"{mm(v):.1f}" if s else f"{deg(v):.1f}" for v, s in zip(q, slides, strict=True)))
        for n, q in enumerate(poses, 1)
    ]
    return section(
        "Record these next",
        '<p class="small soft">Reachable poses at which the best explanations differ most.</p>',
        table(heads, rows, numbers=range(1, len(heads))),
    )


def notes(case: Case) -> str:
    """What a reader should know about the recording or how it was read."""
    said = "".join(f"<li>{escape(note)}</li>" for note in case.diagnosis.notes)
    return section("Notes", f"<ul>{said}</ul>" if said else "")
