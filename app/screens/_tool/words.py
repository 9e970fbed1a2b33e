"""Modes and steps in a maker's words and the operator's language."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.calibration.captures import Mode, Step
from app.calibration.exchange import formats
from app.calibration.modes import modes
from app.calibration.vocabularies import Vocabulary, vocabularies, vocabulary
from app.geometry import CONVENTIONS
from app.texts import has_text

if TYPE_CHECKING:
    from app.screens.context import Context

#: Whose words a language uses where nobody chose a maker's.
_OWN = {"zh": "paper"}


class Words:
    """What things are called.

    Args:
        context: whose language and chosen maker count.
    """

    def __init__(self, context: Context):
        self._context = context

    @property
    def vocabulary(self) -> Vocabulary | None:
        """The maker chosen; None for the modes' own words."""
        return self._of(self._context.language)

    def _of(self, language: str) -> Vocabulary | None:
        key = self._context.vocabulary or _OWN.get(language)
        return vocabulary(key) if key else None

    def makers(self) -> dict[str, str]:
        """Title -> key; an empty key is the modes' own words."""
        return {self._context.t("tool.own_words"): ""} | {v.title: k for k, v in vocabularies().items()}

    def modes(self) -> dict[str, str]:
        """Title -> key of all modes, those the maker has a name for first."""
        words = self.vocabulary
        first = words.modes if words else ()
        known = modes()
        ordered = [k for k in first if k in known] + [k for k in known if k not in first]
        found: dict[str, str] = {}
        for key in ordered:
            title = self.mode(known[key])
            if title in found:  # two modes under one name of the maker's: say which
                title = f"{title} ({known[key].title})"
            found[title] = key
        return found

    def mode(self, mode: Mode) -> str:
        """A mode's name."""
        words = self.vocabulary
        return words.mode_title(mode.key, mode.title, self._context.language) if words else mode.title

    def angles(self, key: str) -> tuple[str, ...]:
        """What the angles of a convention are called: the maker's labels where it is the maker's convention."""
        words = self.vocabulary
        if words is not None and words.convention == key:
            return words.angle_names
        form = CONVENTIONS[key]
        return tuple(c.upper() for c in form.columns) if form.angular else form.columns

    def conventions(self) -> dict[str, str]:
        """Title -> key of all angle conventions."""
        return {self._said(f"angles.{key}", form.title): key for key, form in CONVENTIONS.items()}

    def formats(self) -> dict[str, str]:
        """Title -> key of all formats a tool frame is written in, the own controller's first."""
        words = self.vocabulary
        makers = [words.title] if words else []
        makers.append(self._context.model.description.get("maker", "?"))
        known = formats()

        def rank(key: str) -> int:
            return next(
                (k for k, maker in enumerate(makers) if known[key].title.startswith(maker)), len(makers)
            )

        return {self._said(f"formats.{key}", known[key].title): key for key in sorted(known, key=rank)}

    def _said(self, key: str, own: str) -> str:
        """The operator's words for what has a name of its own; the name where none are needed."""
        return self._context.t(key) if has_text(key, self._context.language) else own

    def radians(self, key: str) -> bool:
        """True where the maker chosen shows this convention in radians."""
        words = self.vocabulary
        return words is not None and words.convention == key and words.angle_unit == "rad"

    def step(self, step: Step) -> Step:
        """A step with its title and instruction restated."""

        def said(language: str) -> Step:
            words = self._of(language)
            return words.step(step, language) if words else step

        now = said(self._context.language)
        self._context.spoken.remember(now.title, lambda language: said(language).title)
        return now
