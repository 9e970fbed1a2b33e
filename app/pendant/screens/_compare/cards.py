"""What the screen says: the recording, the row, the verdict and the findings."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.model import SavedModel
from app.diagnosis.report.wording import (
    effect_title,
    finding_law,
    finding_sentence,
    joint_values,
    judged_rows,
    measure,
    noise_source,
    parameter_name,
    place,
    probability,
    quantity,
    verdict_sentence,
)
from app.diagnosis.result import Diagnosis, Finding, Judged
from app.diagnosis.wording import in_words
from app.pendant import html
from app.units import deg, mm

if TYPE_CHECKING:
    from app.pendant.client import Pendant
    from app.pendant.screens._compare.loaded import Loaded

_MOST_SAID, _MOST_ROWS = 4, 20  # effects of a model, rows set aside
_LIGHT = {"clean": "green", "named": "blue", "partly": "yellow", "unexplained": "red"}


def recording(pendant: Pendant, loaded: Loaded) -> str:
    """Which file, which robot, how many rows."""
    words = pendant.t(
        "compare.recording",
        file=loaded.path.name,
        count=loaded.count,
        robot=loaded.robot.said("title", pendant.language),
    )
    return html.paragraph(words, testid="compare-recording")


def row(pendant: Pendant, loaded: Loaded, index: int, share: float) -> str:
    """The row that is shown: its line, its angles, how far it is off."""
    evidence = loaded.evidence
    line = int(evidence.rows[index])
    slides = [joint.prismatic for joint in loaded.robot.joints]
    angles = "  ".join(
        f"{mm(v):.0f} mm" if s else f"{deg(v):.1f}°" for v, s in zip(evidence.q[index], slides, strict=True)
    )
    if loaded.moving:
        words = pendant.t("compare.moment", line=line, seconds=f"{loaded.moment(index):.2f}")
    else:
        off = float(np.linalg.norm(loaded.vectors(share)[index]))
        words = pendant.t("compare.row_off", line=line, mm=f"{mm(off):.3f}")
        if not evidence.kept[index]:
            words += " " + pendant.t("compare.set_aside")
    below = "" if loaded.moving else _legend(pendant)
    said = html.block(
        f'<b>{escape(words)}</b><div style="opacity:.7">{escape(angles)}</div>{below}', testid="compare-row"
    )
    return said + (_torques(pendant, loaded, index, share) if loaded.moving else "")


def _torques(pendant: Pendant, loaded: Loaded, index: int, share: float) -> str:
    """Measured and simulated torque of every joint at one moment."""
    measured, off = loaded.evidence.measured[index], loaded.off(index, share)
    rows = [
        (pendant.t("compare.measured"), *(f"{v:.1f}" for v in measured)),
        (pendant.t("compare.simulated"), *(f"{v:.1f}" for v in measured - off)),
    ]
    head = ("", *(f"J{j + 1}" for j in range(len(measured))))
    return html.table(rows, head=head, testid="compare-torques")


def _legend(pendant: Pendant) -> str:
    """Which of the two tips is which."""
    marks = (("#d97b16", "compare.legend_simulated"), ("#d62839", "compare.legend_recorded"))
    return "".join(
        f'<div><span style="display:inline-block;width:9px;height:9px;border-radius:50%;background:{colour};'
        f'margin-right:6px"></span>{escape(pendant.t(key))}</div>'
        for colour, key in marks
    )


def verdict(pendant: Pendant, diagnosis: Diagnosis) -> str:
    """The verdict as a light, and the noise it is judged against."""
    source = noise_source(diagnosis.noise.source, pendant.language)
    noise = f"{measure(diagnosis.noise.value, diagnosis.noise.unit)}, {source}"
    said = verdict_sentence(diagnosis, pendant.language)
    return html.light(_LIGHT[diagnosis.verdict], said, testid="compare-verdict") + html.paragraph(
        pendant.t("compare.noise", noise=noise), faint=True
    )


def judged(pendant: Pendant, of: Judged) -> str:
    """A given model on this recording: the error with and without it."""
    rows = judged_rows(of, pendant.language)
    learnt = Path(of.source).name if of.source else "?"
    return html.paragraph(pendant.t("compare.judged", source=learnt)) + html.table(
        rows, testid="compare-judged"
    )


def model(pendant: Pendant, given: SavedModel | None, name: str) -> str:
    """What a saved model holds, and what stands in the practice cell."""
    out = []
    if given is not None:
        out.append(html.paragraph(pendant.t("compare.model_holds", name=name, what=_effects(pendant, given))))
    in_cell = pendant.session.state.cell_model
    if in_cell is not None:
        words = pendant.t("compare.cell_holds", what=_effects(pendant, in_cell))
        out.append(html.paragraph(words, testid="compare-cell", style="font-weight:600"))
    return "".join(out)


def _effects(pendant: Pendant, of: SavedModel) -> str:
    said = [
        f"{effect_title(e.effect, pendant.language)} ({place(e.where, pendant.language)})"
        for e in of.effects[:_MOST_SAID]
    ]
    if len(of.effects) > _MOST_SAID:
        said.append(f"… +{len(of.effects) - _MOST_SAID}")
    return "; ".join(said) or "–"


def notes(pendant: Pendant, diagnosis: Diagnosis) -> str:
    """What else a person should know: rows set aside, the engine's remarks."""
    items = [("yellow", in_words(note, pendant.language)) for note in diagnosis.notes]
    if diagnosis.outliers:
        rows = ", ".join(map(str, diagnosis.outliers[:_MOST_ROWS]))
        more = f" +{len(diagnosis.outliers) - _MOST_ROWS}" if len(diagnosis.outliers) > _MOST_ROWS else ""
        items.insert(0, ("red", pendant.t("compare.outliers", rows=rows + more)))
    return html.notes(items, testid="compare-notes")


def findings(pendant: Pendant, diagnosis: Diagnosis) -> str:
    """One card a finding."""
    return "".join(_card(pendant, n, f, diagnosis.after.unit) for n, f in enumerate(diagnosis.findings, 1))


def _card(pendant: Pendant, number: int, f: Finding, unit: str) -> str:
    unit = f.heldout_unit or unit
    t, language = pendant.t, pendant.language
    rows = [(parameter_name(p.name, language), quantity(p, language)) for p in f.parameters]
    rows += [
        (t("compare.sure"), probability(f.p_value, language)),
        (t("compare.visible"), f"{f.visible:.0%}"),
        (
            t("compare.held_out"),
            f"{measure(f.heldout_rms_without, unit)} → {measure(f.heldout_rms_with, unit)}",
        ),
    ]
    others = ""
    if f.alternatives:
        said = "; ".join(
            f"{effect_title(a.effect, language)}, {place(a.where, language)}" for a in f.alternatives
        )
        others = html.paragraph(t("compare.others", others=said), faint=True)
    head = (
        f'<div style="font-weight:600;font-size:13px">{number}. {escape(effect_title(f.effect, language))}'
        f'<span style="font-weight:400;opacity:.75"> · {escape(place(f.where, language))}</span></div>'
        f'<div style="margin:3px 0">{escape(finding_sentence(f, language))}</div>'
    )
    law = html.block(f"<i>{escape(finding_law(f, language))}</i>", style="opacity:.8") if f.equation else ""
    return html.block(
        head + html.table(rows) + law + others,
        testid=f"compare-finding-{number}",
        style="border-left:4px solid #1866ad;margin:7px 8px;padding:5px 4px 5px 10px",
    )


def next_poses(pendant: Pendant, loaded: Loaded) -> str:
    """The joints of every proposed pose."""
    if loaded.diagnosis is None:
        return ""
    slides = [joint.prismatic for joint in loaded.robot.joints]
    said = "".join(f"<div>{escape(joint_values(q, slides))}</div>" for q in loaded.diagnosis.next_poses)
    return html.block(said, testid="compare-poses")


def truth(pendant: Pendant, hidden: Sequence[dict]) -> str:
    """What was really wrong in the simulated cell."""
    language = pendant.language
    said = "; ".join(f"{effect_title(e['effect'], language)}, {place(e['where'], language)}" for e in hidden)
    return html.paragraph(
        pendant.t("compare.truth", what=said), testid="compare-truth", style="font-weight:600"
    )
