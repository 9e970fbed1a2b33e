"""After accepting: the turn about the new tool point, and the trace of the true tip."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from app.calibration.verify import TOLERANCE, Verification, verify
from app.panel import markup as html
from app.scene.trace import trace_factor
from app.screens._tool.hand import joints_of
from app.session import SessionState
from app.session.motion.guarding import hit, words
from app.session.state import accepted
from app.units import mm

if TYPE_CHECKING:
    from app.screens.context import Context

_EVERY = 4  # of the poses of the turn, each so many-th is shown
_MOVED = 1e-3  # rad or m


class Verifying:
    """The turn and what it showed.

    Args:
        context: where it is shown.
        told: hears that a turn has begun or has shown something.
    """

    def __init__(self, context: Context, told: Callable[[], object] = lambda: None):
        self._context, self._told = context, told
        self.good: bool | None = None  # what the turn about the result at hand has shown; None before one
        self._text = context.ui.add_html("", visible=False)
        self._of: object = None
        self._done = False
        self.found: Verification | None = None

    def run(self) -> None:
        """Turns about the tool point where a touch was recorded; the arm shows it, the trace grows with it."""
        context = self._context
        state = context.session.state
        if state.result is None:
            return
        solved, world, model = state.result, context.world, context.model
        touched = [c for c in state.ordered if "touch" in c.roles]
        starts = [q for c in touched[::-1] if (q := joints_of(context, c)) is not None]

        def tip(flange, q) -> np.ndarray:
            return world.tip(q).position

        def work() -> tuple[Verification | None, str]:
            best: Verification | None = None
            why = ""
            for start in [*starts, np.array(context.q)]:
                found = verify(solved.result, model.forward(start), tip, robot=model, q_start=start)
                joints = [] if found.joints is None else [*found.joints[::_EVERY], *found.joints[-1:]]
                stop = next((s for q in joints if (s := hit(world, q)) is not None), None)
                if stop is not None:
                    why = why or words(stop, context.t, context.language)
                elif not joints:
                    why = why or (context.why(found.hindered) if found.hindered else "")
                elif not found.stopped:
                    return found, ""
                elif best is None or len(found.trace) > len(best.trace):
                    best = found
            return best, why

        def done(outcome: tuple[Verification | None, str]) -> None:
            found, why = outcome
            if found is None or found.joints is None:
                context.say("warning", context.t("message.not_reached", reason=why))
                return
            self.found, self._of, self._done = found, solved, False
            self._text.visible, self.good = False, None
            self._told()
            context.stage.view("close")
            stops = [*found.joints[::_EVERY], found.joints[-1]]

            def turn() -> None:
                context.drive.tour(
                    stops,
                    lambda number: self._arrived(found, number),
                    0.0,
                    context.t("errand.verify"),
                    checked=False,
                )

            context.go(
                stops[0], turn, context.t("errand.verify")
            )  # the way there is looked at, the turn has been

        context.background(work, done)

    def refresh(self, state: SessionState) -> None:
        """Takes the trace away with the result it belongs to."""
        if self.found is not None and (state.result is not self._of or not accepted(state)):
            self.found = self.good = None
            self._text.visible = False
            self._context.stage.show_trace(None, state)

    def numbers(self) -> None:
        """The arm moved: whoever moves it on wants to see tool and handle again; what was found stays written."""
        context, found = self._context, self.found
        if found is None or found.joints is None or context.worker.running("move"):
            return
        if self._done and float(np.abs(context.q - found.joints[-1]).max()) > _MOVED:
            self._done = False
            context.stage.show_trace(None, context.session.state)

    def _arrived(self, found: Verification, number: int) -> None:
        context = self._context
        if found is not self.found:
            return
        if number >= 0:
            until = min(number * _EVERY, len(found.trace) - 1)
            self._trace(found, until)
            return
        self._trace(found)
        self._done = True
        words = self._sentence(found)
        self.good = good = bool(found.good) and not found.stopped
        context.say("good" if good else "warning", words)
        said = html.light("green" if good else "yellow", words, testid="verified")
        if context.world.picture is None:
            said += html.paragraph(self._legend(found), faint=True, testid="trace")
        self._text.content = said
        self._text.visible = True
        self._told()

    def _trace(self, found: Verification, until: int | None = None) -> None:
        """Draws the trace; not in an exercise: from the true tip's way the hidden tool point could be computed."""
        if self._context.world.picture is None:
            self._context.stage.show_trace(found, self._context.session.state, until)

    def _sentence(self, found: Verification) -> str:
        t = self._context.t
        words = t(
            "message.verified_good" if found.good else "message.verified_not",
            mm=f"{mm(found.wander):.2f}",
            off=f"{mm(found.off):.2f}",
            most=f"{mm(TOLERANCE):.2f}",
        )
        if found.hindered is not None:
            words += " " + t("message.verified_stopped", reason=self._context.why(found.hindered))
        return words

    def _legend(self, found: Verification) -> str:
        return self._context.t(
            "tool.trace",
            factor=trace_factor(found),
            rms=f"{mm(found.rms):.2f}",
            axes=" / ".join(
                f"{mm(float(np.max(away[found.axes == axis], initial=0.0))):.2f}"
                for away in [np.linalg.norm(found.trace - found.trace[0], axis=1)]
                for axis in range(3)
            ),
        )
