"""The page: one HTML file that asks nothing of the network and prints on A4."""

from __future__ import annotations

import time
from collections.abc import Sequence
from html import escape
from pathlib import Path

from app.diagnosis.report.parts.case import Case
from app.diagnosis.report.parts.drivers import drivers
from app.diagnosis.report.parts.findings import findings
from app.diagnosis.report.parts.head import head
from app.diagnosis.report.parts.judged import judged
from app.diagnosis.report.parts.lists import leftover, next_poses, notes, outliers
from app.diagnosis.report.parts.making import making, reading
from app.diagnosis.report.parts.space import space
from app.diagnosis.report.parts.timeline import timeline
from app.diagnosis.report.style import CSS
from app.diagnosis.result import Diagnosis
from app.diagnosis.wording import WORDS
from app.errors import InputError
from app.kinematics import RobotModel
from app.phrases import FALLBACK

SECTIONS = (judged, findings, leftover, drivers, space, timeline, outliers, next_poses, notes)


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
        inside = head(case, date) + "".join(part(case) for part in SECTIONS)
        bodies.append(f'<article class="{"again" if bodies else "first"}">{inside}</article>')
    names = ", ".join(Path(d.file).name for d in diagnoses)
    title = WORDS.text("page.title.page", language, names=names)
    seconds = sum(d.seconds for d in diagnoses)
    return (
        f'<!doctype html><html lang="{language}"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width,initial-scale=1">'
        f"<title>{escape(title)}</title><style>{CSS}</style></head><body>"
        f"{''.join(bodies)}{reading(language)}{making(command, seed, seconds, date, language)}</body></html>\n"
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
    path = Path(path)
    temporary = path.with_name(path.name + ".part")
    try:
        page = as_page(diagnoses, robots, command=command, seed=seed, language=language)
        temporary.write_text(page, encoding="utf-8")
        temporary.replace(path)
    except OSError as error:
        raise InputError(f"cannot be written ({error.strerror})", file=path) from None
