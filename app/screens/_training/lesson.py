"""The level of a lesson: a choice before it, what is next after it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.training.exercise import Exercise
from app.training.levels import LEVELS, PASS, levels_of
from app.training.score import ScoreCard

if TYPE_CHECKING:
    from app.screens.context import Context


class LevelChoice:
    """The levels of the chosen exercise; those that were passed are marked, the first that was not is proposed.

    Args:
        context: where it stands.
    """

    def __init__(self, context: Context):
        self._context = context
        self._choice = context.ui.add_choice(context.t("training.level"), ("-",))
        self._titles: dict[str, str] = {}

    @property
    def visible(self) -> bool:
        return self._choice.visible

    @visible.setter
    def visible(self, value: bool) -> None:
        self._choice.visible = value and len(self._titles) > 1

    @property
    def level(self) -> str:
        """The level that is chosen."""
        return self._titles.get(str(self._choice.value), next(iter(LEVELS)))

    @property
    def without(self) -> tuple[str, ...]:
        """Helps it takes away."""
        return LEVELS[self.level]

    def offer(self, exercise: Exercise, tries: list[ScoreCard]) -> None:
        """The levels of this exercise, after these tries."""
        t, levels = self._context.t, levels_of(exercise)
        done = {card.level for card in tries if card.passed}
        self._titles = {
            t(f"training.level_{level}") + (" ✓" if level in done else ""): level for level in levels
        }
        self._choice.options = tuple(self._titles)
        wanted = next((level for level in levels if level not in done), levels[-1])
        self.choose(wanted)

    def choose(self, level: str) -> None:
        """This level, where the exercise has it."""
        found = next((title for title, key in self._titles.items() if key == level), None)
        if found is not None:
            self._choice.value = found


def verdict(context: Context, card: ScoreCard) -> tuple[str, str]:
    """Colour and words: passed, or how much is missing."""
    level = context.t(f"training.level_{card.level}") if card.level else ""
    if card.passed:
        return "green", context.t("training.passed", level=level, mark=f"{PASS:.0f}")
    return "red", context.t("training.not_passed", level=level, mark=f"{PASS:.0f}")
