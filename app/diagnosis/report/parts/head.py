"""The top: which recording, which robot, and the verdict in one sentence."""

from __future__ import annotations

from html import escape
from pathlib import Path

from app.diagnosis.report.drawing.bars import before_after_bars
from app.diagnosis.report.parts.case import Case, figure, key, mark
from app.diagnosis.report.wording import fall, measure, noise_source, verdict_sentence
from app.diagnosis.wording import WORDS


def _robot(case: Case) -> str:
    """A shipped robot's title; for a bare description its file, whose name says more than "robot"."""
    if case.robot is None:
        return case.diagnosis.robot
    return case.robot.title if case.robot.description else case.robot.path.name


def head(case: Case, date: str) -> str:
    """Title, verdict and the bars."""
    d = case.diagnosis
    kind = f"kind.{d.kind}"
    kind = case.t(kind) if WORDS.has(f"page.{kind}") else d.kind
    meta = case.t("meta", kind=kind, samples=d.samples, robot=_robot(case))
    source = noise_source(d.noise.source, case.language)
    noise = case.t("noise", value=measure(d.noise.value, d.noise.unit), source=source)
    marks = mark("n", noise) if d.noise.unit == d.before.unit else ""
    smaller = fall(d.before.heldout_rms, d.after.heldout_rms, case.language)
    caption = case.t("caption.fall", fall=smaller) if d.findings and smaller else case.t("caption.error")
    verdict = f"<b>{case.t(f'verdict.{d.verdict}')}</b>{escape(verdict_sentence(d, case.language))}"
    return (
        f'<header><div class="brand"><span>{case.t("brand")}</span>'
        f"<span>{escape(date)}</span></div>"
        f"<h1>{escape(Path(d.file).name)}</h1><div class='meta'>{escape(meta)}</div></header>"
        f'<div class="verdict {d.verdict}">{verdict}</div>'
        + figure(key(case, marks) + case.picture(before_after_bars(d)), caption)
    )
