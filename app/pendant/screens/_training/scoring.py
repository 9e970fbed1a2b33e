"""The end of an attempt: its score, kept in the records and shown."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.pendant.screens._training import cards, plots
from app.session.actions import Begin, Finish
from app.training.attempt import last_attempt
from app.training.exercise import exercise
from app.training.score import ScoreCard, score

if TYPE_CHECKING:
    from app.pendant.client import Pendant


def finish(pendant: Pendant, action: Finish) -> ScoreCard | None:
    """Ends the exercise, keeps its score and shows it."""
    running = pendant.session.state.running
    pendant.do(action)
    if running is None:
        return None
    trainee, card = _keep(pendant, running.begun)
    if card.given_up:
        pendant.say("info", pendant.t("training.gave_up"))
    else:
        pendant.say("good", pendant.t("training.scored", total=f"{card.total:.0f}"))
        show(pendant, trainee, card)
    return card


def catch_up(pendant: Pendant) -> None:
    """Keeps the score of an exercise that ended just before the server did: between the two it may be killed."""
    entries = pendant.session.entries
    if not entries or not isinstance(entries[-1].action, Finish):
        return
    begun = last_attempt(entries)[0].action
    if isinstance(begun, Begin):
        _keep(pendant, begun)


def _keep(pendant: Pendant, begun: Begin) -> tuple[str, ScoreCard]:
    """The attempt's score, kept once, though the page that is made anew meanwhile catches up with it too."""
    trainee = begun.trainee or pendant.session.name
    card = score(exercise(begun.exercise), last_attempt(pendant.session.entries))
    if not pendant.shelf.records.has(pendant.session.name, begun.at):
        pendant.shelf.records.add(trainee, pendant.session.name, card)
    return trainee, card


def show(pendant: Pendant, trainee: str, card: ScoreCard) -> None:
    """The score card over the page, with the history below it."""
    chosen = exercise(card.exercise)
    gui, t = pendant.client.gui, pendant.t
    modal = gui.add_modal(chosen.said(pendant.language).title)
    with modal:
        gui.add_html(cards.after(pendant, card))
        tries = pendant.shelf.records.history(trainee, chosen.key)
        if len([c for c in tries if not c.given_up]) > 1:
            gui.add_plotly(
                plots.history(pendant, tries, chosen.goal), aspect=plots.ASPECT, config=plots.PLAIN
            )
        pendant.clicked(gui.add_button(t("training.close")), modal.close)
