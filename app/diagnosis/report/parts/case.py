"""What every section is drawn from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from markupsafe import Markup

from app.diagnosis.report.picture_words import translated
from app.diagnosis.report.templating import drawn, render
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

    def picture(self, picture: str) -> Markup:
        """A picture with its labels in the page's language."""
        return drawn(translated(picture, self.language))

    def section(self, template: str, **fields: Any) -> Markup:
        """A section by its template."""
        return render(template, t=self.t, **fields)

    def marks(self, *more: tuple[str, str]) -> list[tuple[str, str]]:
        """What the colours of before and after mean, and further ones: class of the colour, words."""
        said = [("b", self.t("key.before"))]
        if self.changed:
            said.append(("a", self.t("key.found" if self.diagnosis.findings else "key.fitted")))
        return [*said, *more]
