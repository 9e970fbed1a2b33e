"""One file a screen: a tab in the right panel, found by the catalogue.

A file here with an object `SCREEN` of the shape `Screen` is a screen; its texts stand in every language file
under the screen's own key, `[compare]` with at least `title`. What it may use of the pendant:

    pendant.client.gui        widgets: made in `build`, inside the screen's tab
    pendant.client.scene      drawings: under a node of the screen's own, "/compare/…"; SI units, base frame
    pendant.session.state     the frozen SessionState; never kept, always asked for
    pendant.model             RobotModel of the arm that is shown
    pendant.world             the trainee's World
    pendant.q                 (n,) where the shown arm stands
    pendant.t(key, **fields)  a text in the operator's language
    pendant.say(level, text)  the message line: "info", "good", "warning", "error"
    pendant.clicked(button, job)         job runs on the session's worker when the button is clicked
    pendant.changed(widget, slot, job)   the same for inputs; only the newest value counts
    pendant.entered(widget, slot, job, slider=False)   for numbers and texts that are typed: counts once it rests
    pendant.do(action)        an action on the session, then every screen is refreshed (worker thread only)
    pendant.go(q, then=None)  the arm moves to q, visibly (worker thread only)
    pendant.place(q)          the arm stands at q at once (worker thread only)
    pendant.background(job, done)        job() runs on a thread of its own, done(result) on the worker;
                                         an error is told to the operator
    pendant.post(job)         puts a job into the worker's queue, from any thread

Rules: callbacks only enqueue (the helpers above see to it); jobs run one at a time inside `client.atomic()`; what
fails is told on the message line and changes nothing. Long work goes to `background`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from app import catalog
from app.session import SessionState

if TYPE_CHECKING:
    from app.pendant.client import Pendant

SCREENS = "app.pendant.screens"


class ScreenView(Protocol):
    """One browser's copy of a screen."""

    def refresh(self, state: SessionState) -> None:
        """The session changed: show what is different. Called on the worker, inside atomic()."""
        ...

    def close(self) -> None:
        """The browser leaves, or the page is built anew: let go of what is held outside of it."""
        ...


class Screen(Protocol):
    """A kind of screen.

    Args:
        key: its name; texts stand under it, its tab's title is `KEY.title`.
        order: place among the tabs, small first.
    """

    key: str
    order: int

    def build(self, pendant: Pendant) -> ScreenView:
        """Makes the widgets; called inside the screen's tab."""
        ...


def screens() -> list[Screen]:
    """All screens in the order of their tabs."""
    return sorted(catalog.members(SCREENS, "SCREEN").values(), key=lambda screen: screen.order)
