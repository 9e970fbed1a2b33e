"""Training: exercises with a score against a truth nobody tells, and demonstrations of every wizard mode."""

from __future__ import annotations

import secrets
import time
from typing import TYPE_CHECKING, Any

from app.classroom.progress import Lesson, next_lesson, standings
from app.screens._training import cards, plots, scoring
from app.screens._training.lesson import LevelChoice
from app.screens._training.showing import Showing
from app.session import SessionState
from app.session.actions import Finish
from app.training.cell import begin
from app.training.exercise import Exercise, begun_exercise, exercises
from app.training.records import best_of
from app.training.score import ScoreCard

if TYPE_CHECKING:
    from app.screens.context import Context

_SEEDS = 48  # bits: nobody meets the same cell twice, nor guesses one
_CLOCK = 1.0  # seconds between two looks at the clock


class _View:
    def __init__(self, context: Context):
        self.context = context
        ui, t = context.ui, context.t
        self._said_at = 0.0
        scoring.catch_up(context)
        running, session = context.session.state.running, context.session.name
        person = context.shelf.person
        if person is not None:
            context.trainee = person.id
        elif not context.trainee:  # after a reload
            last = context.shelf.records.trainee_of(session)
            context.trainee = (
                running.begun.trainee if running is not None else "" if last == session else last
            )
        self._name = ui.add_text(
            t("training.name"), context.trainee, hint=t("training.name_hint"), visible=person is None
        )
        context.changed(self._name, "trainee", self._named)
        self._list: Any = ui.add_choice(t("training.exercise"), ("-",))
        context.changed(self._list, "exercise", lambda _: self._choose())
        self._level = LevelChoice(context)
        # Above the task, which is as long as its author wrote it: the key to begin is in view on every screen.
        self._begin = ui.add_button(t("training.begin"))
        context.clicked(self._begin, self._start)
        self._card = ui.add_html("")
        self.strip = ui.add_strip()
        with self.strip:
            self._task = ui.add_html("")
            self._answer: Any = ui.add_choice(t("training.answer"), ("-",), visible=False)
            self._number = ui.add_number(
                t("training.number_touch"), 0.0, low=0.0, high=30.0, step=1.0, visible=False
            )
            self._finish_button = ui.add_button(t("training.finish"), rank="plain")
            context.clicked(self._finish_button, self._finish)
            self._sure = False
            context.clicked(ui.add_button(t("training.give_up"), rank="quiet"), self._give_up)
        self._history = ui.add_folder(t("training.history"), visible=False)
        with self._history:
            self._last = ui.add_button(t("training.last_card"), rank="plain")
            context.clicked(self._last, self._show_last)
        self._plot: Any = None
        self.showing = Showing(context)
        self._fill()

    # The list ----------------------------------------------------------------------------------------------

    @property
    def _trainee(self) -> str:
        return self.context.trainee or self.context.session.name

    @property
    def chosen(self) -> Exercise:
        """The exercise in the list."""
        return self._titles[str(self._list.value)]

    def _fill(self) -> None:
        context = self.context
        done = context.shelf.records.history(self._trainee)
        best = best_of(done)
        # The same exercise may be a lesson of two classes: the first one's helps count.
        self._lessons: dict[str, Lesson] = {}
        for one in context.shelf.lessons():
            if one.exercise is not None:
                self._lessons.setdefault(one.key, one)
        given = [one.exercise for one in self._lessons.values() if one.exercise is not None]
        free = [e for e in exercises().values() if e.key not in self._lessons]
        self._titles = {}
        for e in (*given, *free):
            self._titles[cards.title(context, e, best.get(e.key), self._lessons.get(e.key))] = e
        ordered = [self._lessons[e.key] for e in given]
        ahead = next_lesson(ordered, standings(ordered, done, time.time()))
        before = context.exercise if context.exercise in {e.key for e in (*given, *free)} else ""
        before = before or (ahead.key if ahead else (*given, *free)[0].key)
        self._list.options = tuple(self._titles)
        self._list.value = next(title for title, e in self._titles.items() if e.key == before)
        self._offer([card for card in done if card.exercise == before])

    def _choose(self) -> None:
        self._offer(self.context.shelf.records.history(self._trainee, self.chosen.key))

    def _offer(self, done: list[ScoreCard]) -> None:
        """The chosen exercise, its levels, and what was reached in it, `done`."""
        context, chosen = self.context, self.chosen
        context.exercise = chosen.key
        self._card.content = cards.before(context, chosen, self._lessons.get(chosen.key))
        tries = [card for card in done if not card.given_up]
        self._level.offer(chosen, tries)
        self._level.visible = context.session.state.running is None
        self._history.visible = bool(tries) and context.session.state.running is None
        if self._plot is not None:
            self._plot.remove()
            self._plot = None
        if len(tries) > 1:
            with self._history:
                self._plot = context.ui.add_html(plots.history(context, tries, chosen.goal))

    def _named(self, name: str) -> None:
        if self.context.shelf.person is None:
            self.context.trainee = name.strip()
        self._fill()

    # An attempt --------------------------------------------------------------------------------------------

    def _start(self) -> None:
        self.start(self.chosen, self._level.without)

    def choose(self, key: str) -> None:
        """An exercise is chosen from outside this screen; one that is not in the list is not."""
        self.context.exercise = key
        self._fill()

    def start(self, chosen: Exercise, without: tuple[str, ...] = ()) -> None:
        """Begins an exercise, from the list or one that somebody just made.

        Args:
            chosen: which.
            without: helps its level takes away; those that class and lesson do not allow are missing, too.
        """
        context, lesson = self.context, self._lessons.get(chosen.key)
        if lesson is not None:
            without = tuple(dict.fromkeys((*without, *lesson.without)))
        self.showing.stop()
        context.do(begin(chosen, secrets.randbits(_SEEDS), time.time(), context.trainee, without))
        where = "base" if chosen.goal == "relation" else "tool"
        tab = context.t(f"{where}.title")
        context.say("info", context.t("training.begun", title=chosen.said(context.language).title, tab=tab))
        context.open(where)

    def begin_lesson(self, key: str, level: str) -> None:
        """A lesson is begun from its score card: the same again, or the next."""
        self.context.exercise = key
        self._fill()
        self._level.choose(level)
        self._start()

    def _finish(self) -> None:
        context, running = self.context, self.context.session.state.running
        if running is not None and not (self._sure or cards.done(context.session.state, running)):
            self._ask_again(True)  # what is missing scores nothing, and an attempt that is finished is over
            context.say("warning", context.t("training.undone"))
            return
        answer = self._answers.get(str(self._answer.value), "") if self._answer.visible else ""
        number = int(self._number.value) if self._number.visible else 0
        scoring.finish(self.context, Finish(answer, number))

    def _ask_again(self, sure: bool) -> None:
        """Finishing what is not done takes a second press, as accepting a red result does."""
        self._sure = sure
        self._finish_button.label = self.context.t("training.finish_sure" if sure else "training.finish")

    def _give_up(self) -> None:
        scoring.finish(self.context, Finish(given_up=True))

    def _show_last(self) -> None:
        tries = [
            c for c in self.context.shelf.records.history(self._trainee, self.chosen.key) if not c.given_up
        ]
        if tries:
            scoring.show(self.context, self._trainee, tries[-1])

    # What is shown -----------------------------------------------------------------------------------------

    def refresh(self, state: SessionState) -> None:
        """Before an exercise the list, in it the task."""
        running = state.running
        for widget in (self._name, self._list, self._begin):
            widget.visible = running is None
        self._name.visible &= self.context.shelf.person is None
        self._level.visible = running is None
        self.showing.visible = running is None
        self._card.visible = running is None
        self.strip.visible = running is not None
        if running is None:
            self._answer.visible = self._number.visible = False
            self._ask_again(False)
            return
        self._history.visible = False
        self._task.content = cards.running(self.context, running)
        if cards.done(state, running):
            self._ask_again(False)
        self._finish_button.rank = "main" if cards.finished_next(state, running) else "plain"
        question = begun_exercise(running.begun).question
        if question is not None and not self._answer.visible:
            t = self.context.t
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
        running = self.context.session.state.running
        if running is not None and time.monotonic() - self._said_at > _CLOCK:
            self._said_at = time.monotonic()
            self._task.content = cards.running(self.context, running)

    def close(self) -> None:
        """The page goes: a demonstration ends."""
        self.showing.close()


class _Training:
    key, order = "training", 60

    def build(self, context: Context) -> _View:
        return _View(context)


SCREEN = _Training()
