"""Points from a file, shown: the arm goes through them, then the result appears."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from app import resources
from app.kinematics import solve_ik
from app.panel import Upload
from app.screens._tool.words import Words
from app.screens.taking_in import Around, take_small
from app.session.actions import Calculate, ChooseRobot, LoadPoints
from app.session.points import load_action
from app.session.state import FIRST_ROBOT

if TYPE_CHECKING:
    from app.screens.context import Context

PAPER = resources.STATIC / "samples" / "xiong2012_table1.csv"
_LEVELS = {"green": "good", "yellow": "warning", "red": "error"}
_LARGEST = 2_000_000  # bytes of a points file somebody may send


def play_paper_table(context: Context) -> None:
    """The paper's own arm through the paper's own six points, with the paper's estimator."""
    if context.session.state.robot != FIRST_ROBOT:
        context.do(ChooseRobot(FIRST_ROBOT))
    play(context, load_action(PAPER, method="pairwise"))


def play_upload(context: Context, upload: Upload, around: Around) -> None:
    """A file of points somebody sent."""

    def use(action: LoadPoints) -> None:
        if action.robot and action.robot != context.session.state.robot:
            context.do(ChooseRobot(action.robot))
        play(context, action)

    take_small(context, upload, _LARGEST, load_action, use, around)


def play(context: Context, action: LoadPoints) -> None:
    """Loads points, takes the arm through those it can reach, and calculates."""
    state = context.do(action)
    words, titles, stops, q = Words(context), [], [], context.q
    for step, capture in zip(state.steps, state.ordered, strict=True):
        if capture.q is not None:
            q = np.array(capture.q)
        else:
            found = None
            for start in (q, context.model.home):
                found = solve_ik(context.model, capture.T_base_flange, start, max_steps=200)
                if found.reached:
                    break
            if found is None or not found.reached:
                continue
            q = found.q
        stops.append(q)
        titles.append(words.step(step).title)
    # Another arm's points, or another arm is looked at: nothing to show, but the numbers hold.
    if len(stops) < len(state.steps) or context.seen is not None:
        calculate(context)
        return
    context.say("info", context.t("message.loading", source=action.source, count=len(stops)))

    origin = next((i for i, c in enumerate(state.ordered) if "origin" in c.roles), None)
    if origin is not None and origin != len(stops) - 1:  # end where the tip is on the spike
        stops.append(stops[origin])
        titles.append(titles[origin])

    def arrived(number: int) -> None:
        if number >= 0:
            context.say("info", context.t("message.at_point", title=titles[number], source=action.source))
        else:
            calculate(context)

    context.drive.tour(stops, arrived, 0.5, context.t("errand.points", source=action.source), checked=False)


def calculate(context: Context) -> None:
    """The result, the light in words, and a closer look."""
    state = context.do(Calculate())
    if state.result is not None:
        context.open("tool")  # the verdict stands at its top, wherever the list was scrolled to
        colour = state.result.light.colour
        if len(state.result.result.residual_vectors):
            context.stage.view("result")
        context.say(_LEVELS[colour], context.t(f"message.calculated_{colour}"))
