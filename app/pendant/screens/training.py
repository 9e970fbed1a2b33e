"""Training: exercises with a score against a truth nobody tells, and demonstrations of every wizard mode."""

from __future__ import annotations

import secrets
import time
from typing import TYPE_CHECKING, Any

from app.pendant.screens._training import cards, plots, scoring
from app.pendant.screens._training.showing import Showing
from app.session import SessionState
from app.session.actions import Finish
from app.training.cell import begin
from app.training.exercise import Exercise, exercise, exercises

if TYPE_CHECKING:
    from app.pendant.client import Pendant

_SEEDS = 48  # bits: nobody meets the same cell twice, nor guesses one
_CLOCK = 1.0  # seconds between two looks at the clock


class _View:
    def __init__(self, pendant: Pendant):
        self.pendant = pendant
        gui, t = pendant.client.gui, pendant.t
        self._said_at = 0.0
        scoring.catch_up(pendant)
        running, session = pendant.session.state.running, pendant.session.name
        if not pendant.trainee:  # after a reload
            last = pendant.shelf.records.trainee_of(session)
            pendant.trainee = (
                running.begun.trainee if running is not None else "" if last == session else last
            )
        self._name = gui.add_text(t("training.name"), pendant.trainee, hint=t("training.name_hint"))
        pendant.entered(self._name, "trainee", self._named)
        self._list: Any = gui.add_dropdown(t("training.exercise"), ("-",))
        pendant.changed(self._list, "exercise", lambda _: self._choose())
        self._card = gui.add_html("")
        self._begin = gui.add_button(t("training.begin"))
        pendant.clicked(self._begin, self._start)
        self._answer: Any = gui.add_dropdown(t("training.answer"), ("-",), visible=False)
        self._number = gui.add_number(t("training.number_touch"), 0, min=0, max=30, step=1, visible=False)
        self._end = gui.add_button(t("training.finish"), visible=False)
        pendant.clicked(self._end, self._finish)
        self._leave = gui.add_button(t("training.give_up"), color="gray", visible=False)
        pendant.clicked(self._leave, self._give_up)
        self._history = gui.add_folder(t("training.history"), visible=False)
        with self._history:
            self._last = gui.add_button(t("training.last_card"), color="gray")
            pendant.clicked(self._last, self._show_last)
        self._plot: Any = None
        self.showing = Showing(pendant)
        self._fill()

    # The list ----------------------------------------------------------------------------------------------

    @property
    def _trainee(self) -> str:
        return self.pendant.trainee or self.pendant.session.name

    @property
    def chosen(self) -> Exercise:
        """The exercise in the list."""
        return self._titles[str(self._list.value)]

    def _fill(self) -> None:
        best = self.pendant.shelf.records.best(self._trainee)
        self._titles = {cards.title(self.pendant, e, best.get(e.key)): e for e in exercises().values()}
        before = self.pendant.exercise or next(iter(exercises()))
        self._list.options = tuple(self._titles)
        self._list.value = next(title for title, e in self._titles.items() if e.key == before)
        self._choose()

    def _choose(self) -> None:
        pendant, chosen = self.pendant, self.chosen
        pendant.exercise = chosen.key
        self._card.content = cards.before(pendant, chosen)
        tries = [c for c in pendant.shelf.records.history(self._trainee, chosen.key) if not c.given_up]
        self._history.visible = bool(tries) and pendant.session.state.running is None
        if self._plot is not None:
            self._plot.remove()
            self._plot = None
        if len(tries) > 1:
            with self._history:
                self._plot = pendant.client.gui.add_plotly(
                    plots.history(pendant, tries, chosen.goal), aspect=plots.ASPECT, config=plots.PLAIN
                )

    def _named(self, name: str) -> None:
        self.pendant.trainee = name.strip()
        self._fill()

    # An attempt --------------------------------------------------------------------------------------------

    def _start(self) -> None:
        pendant, chosen = self.pendant, self.chosen
        pendant.do(begin(chosen, secrets.randbits(_SEEDS), time.time(), pendant.trainee))
        tab = pendant.t("base.title" if chosen.goal == "relation" else "tool.title")
        pendant.say("info", pendant.t("training.begun", title=chosen.said(pendant.language).title, tab=tab))

    def _finish(self) -> None:
        answer = self._answers.get(str(self._answer.value), "") if self._answer.visible else ""
        number = int(self._number.value) if self._number.visible else 0
        scoring.finish(self.pendant, Finish(answer, number))

    def _give_up(self) -> None:
        scoring.finish(self.pendant, Finish(given_up=True))

    def _show_last(self) -> None:
        tries = [
            c for c in self.pendant.shelf.records.history(self._trainee, self.chosen.key) if not c.given_up
        ]
        if tries:
            scoring.show(self.pendant, self._trainee, tries[-1])

    # What is shown -----------------------------------------------------------------------------------------

    def refresh(self, state: SessionState) -> None:
        """Before an exercise the list, in it the task."""
        running = state.running
        for widget in (self._name, self._list, self._begin):
            widget.visible = running is None
        self.showing.visible = running is None
        self._end.visible = self._leave.visible = running is not None
        if running is None:
            self._answer.visible = self._number.visible = False
            return
        self._history.visible = False
        self._card.content = cards.running(self.pendant, running)
        question = exercise(running.begun.exercise).question
        if question is not None and not self._answer.visible:
            t = self.pendant.t
            self._answers = {t("training.unsaid"): ""} | {
                t(f"training.answer_{c}"): c for c in question.choices
            }
            self._answer.options = tuple(self._answers)
            self._answer.visible = True
            self._number.visible = bool(question.number)
            if question.number:
                self._number.label = t(f"training.number_{question.number}")

    def numbers(self) -> None:
        """The clock of an exercise goes on while somebody works."""
        running = self.pendant.session.state.running
        if running is not None and time.monotonic() - self._said_at > _CLOCK:
            self._said_at = time.monotonic()
            self._card.content = cards.running(self.pendant, running)

    def close(self) -> None:
        """The page goes: a demonstration ends."""
        self.showing.stop()


class _Training:
    key, order = "training", 60

    def build(self, pendant: Pendant) -> _View:
        return _View(pendant)


SCREEN = _Training()
