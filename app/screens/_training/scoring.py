"""The end of an attempt: its score, kept in the records and shown."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from app.classroom.progress import next_lesson, standings
from app.panel import Handle
from app.screens._training import cards, plots
from app.session.actions import Begin, Finish
from app.training.attempt import last_attempt
from app.training.exercise import Exercise, begun_exercise, exercise, exercises
from app.training.levels import levels_of, next_up
from app.training.score import ScoreCard, score

if TYPE_CHECKING:
    from app.screens.context import Context


def finish(context: Context, action: Finish) -> ScoreCard | None:
    """Ends the exercise, keeps its score and shows it."""
    running = context.session.state.running
    context.do(action)
    if running is None:
        return None
    trainee, card = _keep(context, running.begun)
    if card.given_up:
        context.say("info", context.t("training.gave_up"))
    else:
        level = "good" if card.passed else "warning"
        context.say(level, context.t("training.scored", total=f"{card.total:.0f}"))
        show(context, trainee, card)
    return card


def catch_up(context: Context) -> None:
    """Keeps the score of an exercise that ended just before the server did: between the two it may be killed."""
    entries = context.session.entries
    if not entries or not isinstance(entries[-1].action, Finish):
        return
    begun = last_attempt(entries)[0].action
    if isinstance(begun, Begin):
        _keep(context, begun)


def _keep(context: Context, begun: Begin) -> tuple[str, ScoreCard]:
    """The attempt's score, kept once, though the page that is made anew meanwhile catches up with it too."""
    person = context.shelf.person
    trainee = person.id if person is not None else begun.trainee or context.session.name
    card = score(begun_exercise(begun), last_attempt(context.session.entries))
    if person is not None and begun.trainee != person.id:  # somebody else's attempt, in a copy
        return trainee, card
    if not context.shelf.records.has(context.session.name, begun.at):
        context.shelf.records.add(trainee, context.session.name, card)
    return trainee, card


def _ahead(context: Context, trainee: str) -> tuple[Exercise, str] | None:
    """What his class has given him next, as the page of his lessons has it; None where nothing is left."""
    lessons = context.shelf.lessons()
    ahead = next_lesson(lessons, standings(lessons, context.shelf.records.history(trainee), time.time()))
    if ahead is None or ahead.exercise is None:
        return None
    return ahead.exercise, levels_of(ahead.exercise)[0]


def _onward(context: Context, modal: Handle, trainee: str, card: ScoreCard) -> None:
    """Buttons under a score: what is next where it was passed, the same again in any case."""
    t = context.t
    chosen = exercise(card.exercise)

    def begin(key: str, level: str) -> None:
        modal.close()
        for view in context.views:
            if hasattr(view, "begin_lesson"):
                view.begin_lesson(key, level)
                return

    if card.passed and card.level:
        following, level = _ahead(context, trainee) or next_up(chosen, card.level, list(exercises().values()))
        words = t(
            "training.next_up",
            title=following.said(context.language).title,
            level=t(f"training.level_{level}"),
        )
        context.clicked(context.ui.add_button(words), lambda: begin(following.key, level))
    rank = "plain" if card.passed else "main"
    again = context.ui.add_button(t("training.again"), rank=rank)
    context.clicked(again, lambda: begin(chosen.key, card.level or levels_of(chosen)[0]))


def show(context: Context, trainee: str, card: ScoreCard) -> None:
    """The score card over the page, with the history below it."""
    chosen = exercise(card.exercise)
    ui, t = context.ui, context.t
    modal = ui.add_dialog(chosen.said(context.language).title)
    with modal:
        ui.add_html(cards.after(context, card))
        tries = context.shelf.records.history(trainee, chosen.key)
        if len([c for c in tries if not c.given_up]) > 1:
            ui.add_html(plots.history(context, tries, chosen.goal))
        _onward(context, modal, trainee, card)
        context.clicked(ui.add_button(t("training.close"), rank="plain"), modal.close)
        modal.heard = lambda _: context.post(modal.close)
