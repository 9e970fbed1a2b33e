"""What the screen says: the recording, the row, the verdict and the findings."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.model import SavedModel
from app.diagnosis.quantity import quantity
from app.diagnosis.report.budget import (
    SMALL_AMOUNT,
    SMALL_LAW,
    Budget,
    Step,
    budget,
    family_name,
    folded_sentence,
    percent,
    shared_note,
    shown,
    takes_away,
)
from app.diagnosis.report.drawing.palette import colour
from app.diagnosis.report.wording import (
    effect_title,
    finding_law,
    finding_sentence,
    judged_rows,
    measure,
    noise_source,
    parameter_name,
    place,
    probability,
    verdict_sentence,
)
from app.diagnosis.result import Diagnosis, Finding, Judged
from app.diagnosis.wording import in_words
from app.panel import markup as html
from app.units import deg, mm

if TYPE_CHECKING:
    from app.screens._compare.loaded import Loaded
    from app.screens.context import Context

_MOST_SAID, _MOST_ROWS = 4, 20  # effects of a model, rows set aside
_LIGHT = {"clean": "green", "named": "blue", "partly": "yellow", "unexplained": "red"}


def recording(context: Context, loaded: Loaded) -> str:
    """Which file, which robot, how many rows."""
    words = context.t(
        "compare.recording",
        file=loaded.path.name,
        count=loaded.count,
        robot=loaded.robot.said("title", context.language),
    )
    return html.paragraph(words, testid="compare-recording")


def row(context: Context, loaded: Loaded, index: int, share: float) -> str:
    """The row that is shown: its line, its angles, how far it is off."""
    evidence = loaded.evidence
    line = int(evidence.rows[index])
    slides = [joint.prismatic for joint in loaded.robot.joints]
    angles = "  ".join(
        f"{mm(v):.0f} mm" if s else f"{deg(v):.1f}°" for v, s in zip(evidence.q[index], slides, strict=True)
    )
    if loaded.moving:
        words = context.t("compare.moment", row=index + 1, line=line, seconds=f"{loaded.moment(index):.2f}")
    else:
        off = float(np.linalg.norm(loaded.vectors(share)[index]))
        words = context.t("compare.row_off", row=index + 1, line=line, mm=f"{mm(off):.3f}")
        if not evidence.kept[index]:
            words += " " + context.t("compare.set_aside")
    below = "" if loaded.moving else _legend(context)
    said = html.block(
        html.safe('<b>{}</b><div class="faint">{}</div>{}', words, angles, below), testid="compare-row"
    )
    return said + (_torques(context, loaded, index, share) if loaded.moving else "")


def _torques(context: Context, loaded: Loaded, index: int, share: float) -> str:
    """Measured and simulated torque of every joint at one moment."""
    measured, off = loaded.evidence.measured[index], loaded.off(index, share)
    rows = [
        (context.t("compare.measured"), *(f"{v:.1f}" for v in measured)),
        (context.t("compare.simulated"), *(f"{v:.1f}" for v in measured - off)),
    ]
    head = ("", *(f"J{j + 1}" for j in range(len(measured))))
    return html.table(rows, head=head, testid="compare-torques")


def _legend(context: Context) -> str:
    """Which of the two tips is which."""
    marks = (("simulated", "compare.legend_simulated"), ("recorded", "compare.legend_recorded"))
    return html.joined(
        html.safe('<div class="legend {}">{}</div>', look, context.t(key)) for look, key in marks
    )


def verdict(context: Context, diagnosis: Diagnosis) -> str:
    """The verdict as a light, and the noise it is judged against."""
    source = noise_source(diagnosis.noise.source, context.language)
    noise = measure(diagnosis.noise.value, diagnosis.noise.unit)
    said = verdict_sentence(diagnosis, context.language)
    return html.light(_LIGHT[diagnosis.verdict], said, testid="compare-verdict") + html.paragraph(
        context.t("compare.noise", noise=noise, source=source), faint=True
    )


def judged(context: Context, of: Judged) -> str:
    """A given model on this recording: the error with and without it."""
    rows = judged_rows(of, context.language)
    learnt = Path(of.source).name if of.source else "?"
    return html.paragraph(context.t("compare.judged", source=learnt)) + html.table(
        rows, testid="compare-judged"
    )


def model(context: Context, given: SavedModel | None, name: str) -> str:
    """What a saved model holds, and what stands in the practice cell."""
    out = []
    if given is not None:
        out.append(html.paragraph(context.t("compare.model_holds", name=name, what=_effects(context, given))))
    in_cell = context.session.state.cell_model
    if in_cell is not None:
        words = context.t("compare.cell_holds", what=_effects(context, in_cell))
        out.append(html.paragraph(words, testid="compare-cell", strong=True))
    return html.joined(out)


def _effects(context: Context, of: SavedModel) -> str:
    said = [
        f"{effect_title(e.effect, context.language)} ({place(e.where, context.language)})"
        for e in of.effects[:_MOST_SAID]
    ]
    if len(of.effects) > _MOST_SAID:
        said.append(f"… +{len(of.effects) - _MOST_SAID}")
    return "; ".join(said) or "–"


def notes(context: Context, diagnosis: Diagnosis) -> str:
    """What else a person should know: rows set aside, the engine's remarks."""
    items = [("yellow", in_words(note, context.language)) for note in diagnosis.notes]
    if diagnosis.outliers:
        rows = ", ".join(map(str, diagnosis.outliers[:_MOST_ROWS]))
        more = f" +{len(diagnosis.outliers) - _MOST_ROWS}" if len(diagnosis.outliers) > _MOST_ROWS else ""
        items.insert(0, ("red", context.t("compare.outliers", rows=rows + more)))
    return html.notes(items, testid="compare-notes")


def findings(context: Context, diagnosis: Diagnosis) -> str:
    """Families in the budget's order, a card a law beneath; laws that explain little are folded."""
    of, language = budget(diagnosis), context.language
    listed = [step for step in shown(of) if step.members or step.small or not _vanishes(step, of)]
    note = shared_note(listed, of, language)
    out = [html.paragraph(note, faint=True, testid="compare-shared")] if note else []

    def card(k: int, family: str) -> str:
        return _card(context, k + 1, diagnosis.findings[k], diagnosis.after.unit, colour(family))

    for step in listed:
        back = context.t("compare.comes_back", share=percent(step.share))
        words = f"{family_name(step.family, language)} · {takes_away(step, of)}"
        out.append(html.block(html.safe("<b>{}</b> <small>{}</small>", words, back), look="family"))
        out += [card(k, step.family) for k in step.members]
        if step.small:
            folded = folded_sentence(len(step.small), language)
            inside = html.joined(card(k, step.family) for k in step.small)
            out.append(html.block(html.more(folded, inside)))
    return html.joined([*out, *(card(k, "") for k in of.others)])


def _vanishes(step: Step, of: Budget) -> bool:
    """True for a family that neither takes anything to speak of away nor would be missed."""
    return step.amount < SMALL_AMOUNT * of.total and step.share < SMALL_LAW


def _card(context: Context, number: int, f: Finding, unit: str, edge: str) -> str:
    unit = f.heldout_unit or unit
    t, language = context.t, context.language
    rows = [(parameter_name(p.name, language), quantity(p, language)) for p in f.parameters]
    rows += [
        (t("compare.sure"), probability(f.p_value, language)),
        (t("compare.visible"), f"{f.visible:.0%}"),
        (t("compare.held_out_without"), measure(f.heldout_rms_without, unit)),
        (t("compare.held_out_with"), measure(f.heldout_rms_with, unit)),
    ]
    others = ""
    if f.alternatives:
        said = "; ".join(
            f"{effect_title(a.effect, language)}, {place(a.where, language)}" for a in f.alternatives
        )
        others = html.paragraph(t("compare.others", others=said), faint=True)
    head = html.safe(
        "<h4>{}. {}<small> · {}</small></h4><p>{}</p>",
        number,
        effect_title(f.effect, language),
        place(f.where, language),
        finding_sentence(f, language),
    )
    law = html.block(html.safe("<i>{}</i>", finding_law(f, language)), look="faint") if f.equation else ""
    return html.block(
        head + html.table(rows) + law + others,
        testid=f"compare-finding-{number}",
        look="finding",
        edge=edge,
    )


def next_poses(context: Context, loaded: Loaded) -> str:
    """The joints of every proposed pose."""
    if loaded.diagnosis is None:
        return ""
    slides = [joint.prismatic for joint in loaded.robot.joints]
    rows = [
        (str(k), *(f"{mm(v):.0f} mm" if s else f"{deg(v):.0f}°" for v, s in zip(q, slides, strict=True)))
        for k, q in enumerate(loaded.diagnosis.next_poses, 1)
    ]
    return html.table(rows, head=("", *(f"J{j + 1}" for j in range(len(slides)))), testid="compare-poses")


def truth(context: Context, hidden: Sequence[dict]) -> str:
    """What was really wrong in the simulated cell."""
    language = context.language
    said = "; ".join(f"{effect_title(e['effect'], language)}, {place(e['where'], language)}" for e in hidden)
    return html.paragraph(context.t("compare.truth", what=said), testid="compare-truth", strong=True)
