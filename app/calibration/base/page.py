"""Two robots and their relation as a page that can be printed and signed: what the terminal says, in a browser."""

from __future__ import annotations

from collections.abc import Sequence

from app.calibration.base.relation import Relation
from app.calibration.base.report import base_text, relation_text
from app.calibration.base.result import BaseCalibration
from app.calibration.base.wording import TEXTS
from app.templating import templates


def base_page(
    robots: Sequence[str],
    bases: Sequence[BaseCalibration],
    relation: Relation | None,
    *,
    made: str,
    language: str,
) -> str:
    """A page of what was found; nothing of a cell's hidden truth is in it. Every text in it is escaped.

    Args:
        robots: their titles, in order.
        bases: one a robot.
        relation: of the two, where it was found.
        made: date and time as text.
        language: of the page.
    """
    texts = [base_text(base, language) for base in bases]
    texts += [relation_text(relation, language)] if relation is not None else []
    title = TEXTS.text("report.two", language).strip()
    return (
        templates(__file__)
        .get_template("bases.html")
        .render(language=language, title=title, robots=" + ".join(robots), made=made, texts=texts)
    )
