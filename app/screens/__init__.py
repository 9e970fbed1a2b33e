"""One file a screen: a tab of the page, found by the catalogue.

A file here with an object `SCREEN` of the shape `Screen` is a screen; its texts stand in every language file
under the screen's own key, `[compare]` with at least `title`. What it may use is `Context` (context.py): `context.ui`
for widgets, made in `build`; `context.stage.scene` for drawings under a node of the screen's own, "/compare/…", in
metres and base; the session, the arm's drive, the operator's texts.

Rules: what is heard from a page only enqueues (`context.clicked`, `chosen`, `changed`, `uploaded` see to it); jobs run
one at a time; what fails is told on the message line and changes nothing. Long work goes to `context.background`. The
arm moves by `context.go` and `context.drive`, and so only while somebody holds the enabling switch. A view may have
`numbers()`, which is called about five times a second while the arm moves.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from app import catalog
from app.session import SessionState

if TYPE_CHECKING:
    from app.screens.context import Context

SCREENS = "app.screens"


class ScreenView(Protocol):
    """One session's copy of a screen."""

    def refresh(self, state: SessionState) -> None:
        """The session changed: show what is different. Called on the worker."""
        ...

    def close(self) -> None:
        """The session ends, or the screens are made anew: let go of what is held outside of it."""
        ...


class Screen(Protocol):
    """A kind of screen.

    Args:
        key: its name; texts stand under it, its tab's title is `KEY.title`.
        order: place among the tabs, small first.
    """

    key: str
    order: int

    def build(self, context: Context) -> ScreenView:
        """Makes the widgets; called inside the screen's tab."""
        ...


def screens() -> list[Screen]:
    """All screens in the order of their tabs."""
    return sorted(catalog.members(SCREENS, "SCREEN").values(), key=lambda screen: screen.order)
