"""The top: which recording, which robot, and the verdict in one sentence."""

from __future__ import annotations

from html import escape
from pathlib import Path

from app.diagnosis.report.drawing.bars import before_after_bars
from app.diagnosis.report.parts.case import Case, figure, key
from app.diagnosis.report.wording import fall, measure, noise_source, verdict_sentence

_VERDICTS = {"clean": "Clean", "named": "Named", "partly": "Partly explained", "unexplained": "Unexplained"}


def _robot(case: Case) -> str:
    """A shipped robot's title; for a bare description its file, whose name says more than "robot"."""
    if case.robot is None:
        return case.diagnosis.robot
    return case.robot.title if case.robot.description else case.robot.path.name


def head(case: Case, date: str) -> str:
    """Title, verdict and the bars."""
    d = case.diagnosis
    title = _robot(case)
    meta = f"{d.kind} recording, {d.samples} samples · robot {title}"
    noise = f"{measure(d.noise.value, d.noise.unit)} {noise_source(d.noise.source)}"
    marks = f'<span><i class="n"></i>noise: {escape(noise)}</span>' if d.noise.unit == d.before.unit else ""
    smaller = fall(d.before.heldout_rms, d.after.heldout_rms)
    caption = (
        f"Error on rows the fit never saw: {smaller}."
        if d.findings and smaller
        else "Root mean square of one component of the error."
    )
    return (
        f'<header><div class="brand"><span>Teachframe · where simulation and recording differ</span>'
        f"<span>{escape(date)}</span></div>"
        f"<h1>{escape(Path(d.file).name)}</h1><div class='meta'>{escape(meta)}</div></header>"
        f'<div class="verdict {d.verdict}"><b>{_VERDICTS[d.verdict]}</b>{escape(verdict_sentence(d))}</div>'
        + figure(key(case, marks) + before_after_bars(d), caption)
    )
