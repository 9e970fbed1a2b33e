"""Points from a file, shown: the arm goes through them, then the result appears."""

from __future__ import annotations

import tempfile
from typing import TYPE_CHECKING

import numpy as np

from app import resources
from app.kinematics import solve_ik
from app.pendant.screens._tool.words import Words
from app.pendant.uploads import put
from app.session.actions import Calculate, ChooseRobot, LoadPoints
from app.session.points import load_action
from app.session.state import FIRST_ROBOT

if TYPE_CHECKING:
    from app.pendant.client import Pendant

PAPER = resources.STATIC / "samples" / "xiong2012_table1.csv"
_LEVELS = {"green": "good", "yellow": "warning", "red": "error"}
_LARGEST = 2_000_000  # bytes of a points file somebody may send


def play_paper_table(pendant: Pendant) -> None:
    """The paper's own arm through the paper's own six points, with the paper's estimator."""
    if pendant.session.state.robot != FIRST_ROBOT:
        pendant.do(ChooseRobot(FIRST_ROBOT))
    play(pendant, load_action(PAPER, method="pairwise"))


def play_upload(pendant: Pendant, name: str, content: bytes) -> None:
    """A file somebody sent from the browser; it is read where nobody else sees it and not kept."""
    with tempfile.TemporaryDirectory() as folder:
        path = put(pendant, folder, name, content, otherwise="points.csv", most=_LARGEST)
        if path is None:
            return
        action = load_action(path)
    if action.robot and action.robot != pendant.session.state.robot:
        pendant.do(ChooseRobot(action.robot))
    play(pendant, action)


def play(pendant: Pendant, action: LoadPoints) -> None:
    """Loads points, takes the arm through those it can reach, and calculates."""
    state = pendant.do(action)
    words, titles, stops, q = Words(pendant), [], [], pendant.q
    for step, capture in zip(state.steps, state.ordered, strict=True):
        if capture.q is not None:
            q = np.array(capture.q)
        else:
            found = None
            for start in (q, pendant.model.home):
                found = solve_ik(pendant.model, capture.T_base_flange, start, max_steps=200)
                if found.reached:
                    break
            if found is None or not found.reached:
                continue
            q = found.q
        stops.append(q)
        titles.append(words.step(step).title)
    if len(stops) < len(state.steps):  # another arm's points: nothing to show, but the numbers hold
        calculate(pendant)
        return
    pendant.say("info", pendant.t("message.loading", source=action.source, count=len(stops)))

    origin = next((i for i, c in enumerate(state.ordered) if "origin" in c.roles), None)
    if origin is not None and origin != len(stops) - 1:  # end where the tip is on the spike
        stops.append(stops[origin])
        titles.append(titles[origin])

    def arrived(number: int) -> None:
        if number >= 0:
            pendant.say("info", pendant.t("message.at_point", title=titles[number], source=action.source))
        else:
            calculate(pendant)

    pendant.tour(stops, arrived, checked=False)


def calculate(pendant: Pendant) -> None:
    """The result, the light in words, and a closer look."""
    state = pendant.do(Calculate())
    if state.result is not None:
        colour = state.result.light.colour
        if len(state.result.result.residual_vectors):
            pendant.stage.view("result")
        pendant.say(_LEVELS[colour], pendant.t(f"message.calculated_{colour}"))
