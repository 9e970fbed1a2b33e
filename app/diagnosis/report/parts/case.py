"""What every section is drawn from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from typing import Any

from app.diagnosis.report.picture_words import translated
from app.diagnosis.result import Diagnosis
from app.diagnosis.wording import WORDS
from app.kinematics import RobotModel
from app.phrases import FALLBACK


@dataclass(frozen=True)
class Case:
    """One diagnosis and the robot it is about; without the robot some pictures are plainer.

    Args:
        language: of the page.
    """

    diagnosis: Diagnosis
    robot: RobotModel | None = None
    language: str = FALLBACK

    @property
    def changed(self) -> bool:
        """True where there is a model beside the bare description: findings, or geometry fitted alongside."""
        d = self.diagnosis
        return bool(d.findings) or d.before != d.after

    @property
    def prismatic(self) -> tuple[bool, ...]:
        return tuple(joint.prismatic for joint in self.robot.joints) if self.robot else ()

    def t(self, key: str, /, **fields: Any) -> str:
        """The page's own words."""
        return WORDS.text(f"page.{key}", self.language, **fields)

    def picture(self, drawn: str) -> str:
        """A picture with its labels in the page's language."""
        return translated(drawn, self.language)


def section(title: str, *content: str) -> str:
    """A heading with what belongs to it; nothing where there is nothing."""
    inside = "".join(content)
    return f"<section><h2>{escape(title)}</h2>{inside}</section>" if inside else ""


def figure(picture: str, caption: str = "") -> str:
    return f"<figure>{picture}{f'<figcaption>{escape(caption)}</figcaption>' if caption else ''}</figure>"


def table(
    heads: Sequence[str], rows: Sequence[Sequence[str]], *, numbers: Sequence[int] = (), fit: bool = False
) -> str:
    """A table of plain texts; `numbers` are the columns that line up on the right; `fit` is no wider than needed."""

    def cells(name: str, row: Sequence[str]) -> str:
        right = [' class="n"' if i in numbers else "" for i in range(len(row))]
        return "".join(f"<{name}{r}>{escape(cell)}</{name}>" for r, cell in zip(right, row, strict=True))

    body = "".join(f"<tr>{cells('td', row)}</tr>" for row in rows)
    look = ' class="fit"' if fit else ""
    return f"<table{look}><thead><tr>{cells('th', heads)}</tr></thead><tbody>{body}</tbody></table>"


def mark(colour: str, words: str) -> str:
    """One colour of the key and what it means."""
    return f'<span><i class="{colour}"></i>{escape(words)}</span>'


def soft(words: str) -> str:
    """A remark under a heading."""
    return f'<p class="small soft">{escape(words)}</p>'


def key(case: Case, *more: str) -> str:
    """What the colours mean."""
    said = mark("b", case.t("key.before"))
    if case.changed:
        said += mark("a", case.t("key.found" if case.diagnosis.findings else "key.fitted"))
    return f'<div class="key">{said}{"".join(more)}</div>'
