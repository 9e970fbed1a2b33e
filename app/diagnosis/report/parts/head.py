"""The top: which recording, which robot, and the verdict in one sentence."""

from __future__ import annotations

from pathlib import Path

from markupsafe import Markup

from app.diagnosis.report.parts.case import Case
from app.diagnosis.report.wording import verdict_sentence
from app.diagnosis.wording import WORDS


def head(case: Case, date: str) -> Markup:
    """Title and verdict."""
    d = case.diagnosis
    kind = f"kind.{d.kind}"
    kind = case.t(kind) if WORDS.has(f"page.{kind}") else d.kind
    return case.section(
        "head.html",
        date=date,
        name=Path(d.file).name,
        meta=case.t("meta", kind=kind, samples=d.samples, robot=_robot(case)),
        verdict=d.verdict,
        sentence=verdict_sentence(d, case.language),
    )


def _robot(case: Case) -> str:
    """A shipped robot's title; for a bare description its file, whose name says more than "robot"."""
    if case.robot is None:
        return case.diagnosis.robot
    return case.robot.title if case.robot.description else case.robot.path.name
