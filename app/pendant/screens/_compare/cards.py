"""What the screen says: the recording, the row, the verdict and the findings."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import TYPE_CHECKING

import numpy as np

from app.diagnosis.report.wording import (
    NOISE_SOURCES,
    effect_title,
    measure,
    place,
    probability,
    quantity,
    verdict_sentence,
)
from app.diagnosis.result import Diagnosis, Finding
from app.pendant import html
from app.units import deg, mm

if TYPE_CHECKING:
    from app.pendant.client import Pendant
    from app.pendant.screens._compare.loaded import Loaded

_LIGHT = {"clean": "green", "named": "blue", "partly": "yellow", "unexplained": "red"}


def recording(pendant: Pendant, loaded: Loaded) -> str:
    """Which file, which robot, how many rows."""
    words = pendant.t(
        "compare.recording", file=loaded.path.name, count=loaded.count, robot=loaded.robot.title
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
        seconds = evidence.seconds
        at = 0.0 if seconds is None else float(seconds[index] - seconds[0])
        words = pendant.t("compare.moment", line=line, seconds=f"{at:.2f}")
    else:
        off = float(np.linalg.norm(loaded.vectors(share)[index]))
        words = pendant.t("compare.row_off", line=line, mm=f"{mm(off):.3f}")
        if not evidence.kept[index]:
            words += " " + pendant.t("compare.set_aside")
    legend = "" if loaded.moving else _legend(pendant)
    return html.block(
        f'<b>{escape(words)}</b><div style="opacity:.7">{escape(angles)}</div>{legend}', testid="compare-row"
    )


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
    noise = f"{measure(diagnosis.noise.value, diagnosis.noise.unit)}, {NOISE_SOURCES[diagnosis.noise.source]}"
    return html.light(
        _LIGHT[diagnosis.verdict], verdict_sentence(diagnosis), testid="compare-verdict"
    ) + html.paragraph(pendant.t("compare.noise", noise=noise), faint=True)


def findings(pendant: Pendant, diagnosis: Diagnosis) -> str:
    """One card a finding."""
    return "".join(_card(pendant, n, f, diagnosis.after.unit) for n, f in enumerate(diagnosis.findings, 1))


def _card(pendant: Pendant, number: int, f: Finding, unit: str) -> str:
    t = pendant.t
    rows = [(p.name.replace("_", " "), quantity(p)) for p in f.parameters]
    rows += [
        (t("compare.sure"), probability(f.p_value)),
        (t("compare.visible"), f"{f.visible:.0%}"),
        (
            t("compare.held_out"),
            f"{measure(f.heldout_rms_without, unit)} → {measure(f.heldout_rms_with, unit)}",
        ),
    ]
    others = ""
    if f.alternatives:
        said = "; ".join(f"{effect_title(a.effect)}, {place(a.where)}" for a in f.alternatives)
        others = html.paragraph(t("compare.others", others=said), faint=True)
    head = (
        f'<div style="font-weight:600;font-size:13px">{number}. {escape(effect_title(f.effect))}'
        f'<span style="font-weight:400;opacity:.75"> · {escape(place(f.where))}</span></div>'
        f'<div style="margin:3px 0">{escape(f.sentence)}</div>'
    )
    law = html.block(f"<i>{escape(f.equation)}</i>", style="opacity:.8") if f.equation else ""
    return html.block(
        head + html.table(rows) + law + others,
        testid=f"compare-finding-{number}",
        style="border-left:4px solid #1866ad;margin:7px 8px;padding:5px 4px 5px 10px",
    )


def truth(pendant: Pendant, hidden: Sequence[dict]) -> str:
    """What was really wrong in the simulated cell."""
    said = "; ".join(f"{effect_title(e['effect'])}, {place(e['where'])}" for e in hidden)
    return html.paragraph(
        pendant.t("compare.truth", what=said), testid="compare-truth", style="font-weight:600"
    )
