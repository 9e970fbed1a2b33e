"""The page: one HTML file that asks nothing of the network and prints on A4."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path

from app import __version__
from app.diagnosis.report.parts.budget import where_from
from app.diagnosis.report.parts.case import Case
from app.diagnosis.report.parts.drivers import drivers
from app.diagnosis.report.parts.findings import findings
from app.diagnosis.report.parts.head import head
from app.diagnosis.report.parts.joints import joints
from app.diagnosis.report.parts.judged import judged
from app.diagnosis.report.parts.lists import lists
from app.diagnosis.report.parts.space import space
from app.diagnosis.report.parts.torques import torques
from app.diagnosis.report.style import CSS
from app.diagnosis.report.templating import drawn, render
from app.diagnosis.result import Diagnosis
from app.diagnosis.wording import WORDS
from app.files import write_text
from app.kinematics import RobotModel
from app.phrases import FALLBACK

SECTIONS = (where_from, judged, findings, joints, torques, drivers, space, lists)
GLOSSARY = ("budget", "before_after", "held_out", "certainty", "visible", "std", "delta_bic")


def as_page(
    diagnoses: Sequence[Diagnosis],
    robots: Sequence[RobotModel | None],
    *,
    command: str,
    seed: int = 0,
    date: str | None = None,
    language: str = FALLBACK,
) -> str:
    """One page for one or several diagnoses.

    Args:
        robots: the robot of each, or None.
        command: how to make it again.
        date: what stands on it as its date; None is now.
        language: of the page; notes of the engines and names from outside stay as they are.
    """
    date = time.strftime("%Y-%m-%d %H:%M") if date is None else date
    bodies = []
    for diagnosis, robot in zip(diagnoses, robots, strict=True):
        case = Case(diagnosis, robot, language)
        bodies.append([head(case, date), *(part(case) for part in SECTIONS)])

    def t(key: str, **fields: object) -> str:
        return WORDS.text(f"page.{key}", language, **fields)

    seconds = sum(d.seconds for d in diagnoses)
    return render(
        "page.html",
        language=language,
        title=t("title.page", names=", ".join(Path(d.file).name for d in diagnoses)),
        css=drawn(CSS),
        bodies=bodies,
        t=t,
        glossary=GLOSSARY,
        made=t("made", version=__version__, date=date, seconds=f"{seconds:.2f}", seed=seed),
        command=command,
    )


def write_report(
    path: str | Path,
    diagnoses: Sequence[Diagnosis],
    robots: Sequence[RobotModel | None],
    *,
    command: str,
    seed: int = 0,
    language: str = FALLBACK,
) -> None:
    """Writes the page of `as_page`, whole or not at all.

    Raises:
        InputError: the file cannot be written.
    """
    write_text(path, as_page(diagnoses, robots, command=command, seed=seed, language=language))
