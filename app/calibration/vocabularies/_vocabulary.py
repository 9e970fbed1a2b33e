"""What a vocabulary holds, and how it restates a wizard's step."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace

from app.calibration.captures import Step
from app.calibration.vocabularies._chinese import INSTRUCTIONS, MODES, STEPS

#: Languages every vocabulary speaks.
LANGUAGES = ("en", "zh")


@dataclass(frozen=True)
class Words:
    """One language of a vocabulary.

    Args:
        modes: mode key -> the maker's name for it; modes without a name keep their own title.
        steps: role -> title; `{n}` is the number of the step among its kind.
        mean: what the maker calls the mean error, over the touches, off the touched point.
        max: what the maker calls the largest.
    """

    modes: Mapping[str, str]
    steps: Mapping[str, str]
    mean: str
    max: str


@dataclass(frozen=True)
class Vocabulary:
    """A maker's words.

    Args:
        key: the catalogue name.
        title: the maker.
        convention: key of the angle convention its pendants show.
        angle_names: labels of the angles on those pendants.
        words: language -> words.
        angle_unit: "deg" or "rad", what those pendants show angles in.
    """

    key: str
    title: str
    convention: str
    angle_names: tuple[str, ...]
    words: Mapping[str, Words]
    angle_unit: str = "deg"

    @property
    def modes(self) -> tuple[str, ...]:
        """Modes that this maker has a name for, in the maker's order."""
        return tuple(self.words["en"].modes)

    def mode_title(self, key: str, fallback: str, language: str = "en") -> str:
        """The maker's name of a mode, else its own name in that language, else `fallback`."""
        own = MODES.get(key, fallback) if language == "zh" else fallback
        return self._words(language).modes.get(key, own)

    def step(self, step: Step, language: str = "en") -> Step:
        """The same step with its title, and where the language is not English its instruction, restated."""
        number = re.search(r"(\d+)\Z", step.key)
        own = STEPS.get(step.role) if language == "zh" else None
        template = self._words(language).steps.get(step.role, own)
        title = template.format(n=number.group(1) if number else "").strip() if template else step.title
        instruction = step.instruction
        if language == "zh":
            role = "first_touch" if step.key == "touch1" else step.role
            instruction = INSTRUCTIONS.get(role, instruction)
        return replace(step, title=title, instruction=instruction)

    def _words(self, language: str) -> Words:
        return self.words.get(language, self.words["en"])
