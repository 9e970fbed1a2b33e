"""Everything written on one browser's page: both panels, the status line, the screens."""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING

from app.errors import one_line
from app.pendant import html
from app.pendant.panels import panels
from app.pendant.screens import Screen, ScreenView, screens
from app.session import SessionState
from app.units import mm

if TYPE_CHECKING:
    from app.pendant.client import Pendant


_LOG = logging.getLogger(__name__)


class Page:
    """The panels of one browser.

    Args:
        pendant: whose session is shown.
    """

    def __init__(self, pendant: Pendant):
        self._pendant = pendant
        self._views: list[ScreenView] = []
        for panel in panels():
            with pendant.layout.left.add_tab(pendant.t(f"{panel.key}.title")):
                self._build(panel)
        tabs = pendant.client.gui.add_tab_group()
        for screen in screens():
            with tabs.add_tab(pendant.t(f"{screen.key}.title")):
                self._build(screen)

    @property
    def views(self) -> tuple[ScreenView, ...]:
        """The panels and screens that are on the page."""
        return tuple(self._views)

    def _build(self, screen: Screen) -> None:
        """One tab; where it cannot be made, the others still can."""
        try:
            self._views.append(screen.build(self._pendant))
        except Exception as error:
            _LOG.exception("the screen %s could not be made", screen.key)
            what = one_line(f"{screen.key}: {type(error).__name__}: {error}", 160)
            self._pendant.say("error", self._pendant.t("message.fault", what=what))

    def refresh(self, state: SessionState) -> None:
        """The session changed."""
        for view in self._views:
            view.refresh(state)
        self.numbers()

    def numbers(self) -> None:
        """The arm moved."""
        for view in self._views:
            numbers = getattr(view, "numbers", None)
            if numbers is not None:
                numbers()
        self._pendant.stage.follow()
        self._status()

    def close(self) -> None:
        """The page goes away."""
        for view in self._views:
            view.close()
        self._views = []

    def _status(self) -> None:
        pendant, t = self._pendant, self._pendant.t
        state = pendant.session.state
        distance = pendant.world.distance(pendant.q)
        touching = distance <= pendant.world.contact_distance
        if touching:
            far = t("status.touching")
        else:
            far = (
                t("status.distance", mm=f"{mm(distance):.1f}") if pendant.aids.distance else t("status.free")
            )
        moving = pendant.worker.running("move") or pendant.worker.running("jog")
        how = "stopped" if pendant.jogging.stopped else "moving" if moving else "standing"
        colour = {"stopped": "red", "moving": "yellow", "standing": "green"}[how]
        tool = state.tool
        jogging = pendant.jogging
        enabling = "enabled" if jogging.enabled else "locked"
        items = [
            html.item(t(f"status.{how}"), testid="status-state", colour=colour, strong=True),
            html.item(t(f"status.{enabling}"), testid="status-enable"),
            html.item(t("status.frame", name=t(f"jog.frame_{jogging.frame}")), testid="status-frame"),
            html.item(f"{100 * jogging.override:.0f} %", testid="status-speed"),
            html.item(pendant.model.said("title", pendant.language), testid="status-robot", gives=True),
            html.item(
                t("status.tool", name=tool.name) if tool else t("status.no_tool"),
                testid="status-tool",
                gives=True,
            ),
            html.item(
                t("status.points", done=len(state.steps) - len(state.missing), all=len(state.steps)),
                testid="status-points",
            ),
            html.item(far, testid="status-touch", colour="green" if touching else "grey"),
        ]
        pendant.layout.status("".join(items))
