"""Tables of a class: for a spreadsheet, and for the gradebooks of two learning platforms.

Moodle (Grades, Import, CSV file) takes a row a person and a column a grade, and asks which column says who it is:
`Username` is mapped to its `username`; grades are points of 100, `-` is no grade (its grade/import/csv/classes).
Canvas (Grades, Import) wants Student, ID, SIS User ID, SIS Login ID and Section first, in this order, and a row
`Points Possible` below the head; it finds a person by ID, SIS user or login, then by name (lib/gradebook_importer.rb).
In both, what somebody logs in with here has to be what he logs in with there.
"""

from __future__ import annotations

import csv
import io
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from app.classroom.progress import Lesson, Standing

#: Signs a spreadsheet takes for the beginning of a formula.
_FORMULA = ("=", "+", "-", "@", "\t", "\r")
_POSSIBLE = 100.0
_NONE = "-"


@dataclass(frozen=True)
class Row:
    """One trainee.

    Args:
        name, login: of the person.
        standings: lesson id -> how he stands.
    """

    name: str
    login: str
    standings: Mapping[str, Standing]


def scores_csv(rows: Sequence[Row], lessons: Sequence[Lesson], language: str) -> str:
    """A row a trainee and lesson: best, tries, error and time of the last try, trend."""
    head = (
        "name", "login", "exercise", "title", "best", "passed", "tries", "last_error_mm", "last_time_s", "last_begun",
        "trend_points_per_try", "due", "late",
    )  # fmt: skip
    out: list[Sequence[str]] = [head]
    for row in rows:
        for lesson in lessons:
            at = row.standings.get(lesson.id, Standing())
            out.append(
                (
                    row.name, row.login, lesson.key, lesson.title(language), _number(at.best), str(at.passed).lower(),
                    str(at.tries), _number(at.error, 3), _number(at.seconds), _moment(at.last), _number(at.trend, 2),
                    _moment(lesson.due), str(at.late).lower(),
                )
            )  # fmt: skip
    return _written(out)


def moodle_csv(rows: Sequence[Row], lessons: Sequence[Lesson], language: str) -> str:
    """Grades as Moodle's import reads them: the best of each lesson, in points of 100."""
    out = [("Full name", "Username", *_titles(lessons, language))]
    out += [(row.name, row.login, *(_grade(row, lesson) or _NONE for lesson in lessons)) for row in rows]
    return _written(out)


def canvas_csv(rows: Sequence[Row], lessons: Sequence[Lesson], language: str, section: str) -> str:
    """Grades as the import of Canvas reads them; `section` is the class."""
    known = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")
    out = [
        (*known, *_titles(lessons, language)),
        ("Points Possible", "", "", "", "", *(f"{_POSSIBLE:g}" for _ in lessons)),
    ]
    out += [
        (row.name, "", "", row.login, section, *(_grade(row, lesson) for lesson in lessons)) for row in rows
    ]
    return _written(out)


def _titles(lessons: Sequence[Lesson], language: str) -> list[str]:
    """Titles, made different where two lessons are called the same: a column has one name."""
    out: list[str] = []
    for lesson in lessons:
        title, number = lesson.title(language), 2
        while title in out:
            title, number = f"{lesson.title(language)} {number}", number + 1
        out.append(title)
    return out


def _grade(row: Row, lesson: Lesson) -> str:
    return _number(row.standings.get(lesson.id, Standing()).best)


def _number(value: float | None, digits: int = 1) -> str:
    return "" if value is None else f"{value:.{digits}f}"


def _moment(at: float) -> str:
    return time.strftime("%Y-%m-%d %H:%M", time.localtime(at)) if at else ""


def _written(rows: Sequence[Sequence[str]]) -> str:
    """CSV (RFC 4180). A text that a spreadsheet would calculate gets an apostrophe before it; numbers do not."""
    out = io.StringIO()
    csv.writer(out).writerows([[_harmless(cell) for cell in row] for row in rows])
    return out.getvalue()


def _harmless(cell: str) -> str:
    if not cell.startswith(_FORMULA) or cell == _NONE:
        return cell
    try:
        float(cell)
    except ValueError:
        return f"'{cell}"
    return cell
